#include "framework/pipeline/pipeline.hpp"

#include <chrono>
#include <new>
#include <optional>
#include <stdexcept>

namespace croon {
namespace {

using Clock = std::chrono::steady_clock;

/// Seconds since `start`, less the shared work that this thread did or waited for in between.
double own_seconds(Clock::time_point start, double shared_before) {
  const double wall = std::chrono::duration<double>(Clock::now() - start).count();
  return wall - (seconds_spent_on_shared_work() - shared_before);
}

}  // namespace

PipelineResult run_pipeline(const Pipeline& pipeline, std::shared_ptr<const Cloud> target,
                            std::shared_ptr<const Cloud> source, const RigidTransform& start,
                            const StreamKey& key) {
  PipelineResult result;
  result.estimate.target = std::move(target);
  result.estimate.source = std::move(source);
  result.estimate.T_target_source = start;
  std::optional<std::string> rejection;
  for (const auto& [name, step] : pipeline) {
    const double shared_before = seconds_spent_on_shared_work();
    const Clock::time_point step_start = Clock::now();
    Rng rng(key.with(name));
    result.estimate.figures.clear();
    result.estimate.rejection.reset();
    try {
      result.estimate = step->advance(result.estimate, rng);
    } catch (const std::logic_error&) {
      throw;
    } catch (const std::bad_alloc&) {
      // Of this machine at this time, not of the data: must not become a result.
      throw;
    } catch (const std::exception& error) {
      result.failure = name + ": " + error.what();
    }
    if (result.estimate.rejection) rejection = name + ": " + *result.estimate.rejection;
    result.records.push_back(
        {name, own_seconds(step_start, shared_before), result.estimate.figures});
    if (!result.failure.empty()) break;
  }
  result.estimate.rejection = rejection;
  return result;
}

}  // namespace croon

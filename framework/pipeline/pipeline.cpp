#include "framework/pipeline/pipeline.hpp"

#include <chrono>
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
  for (std::size_t i = 0; i < pipeline.size(); ++i) {
    const double shared_before = seconds_spent_on_shared_work();
    const Clock::time_point step_start = Clock::now();
    Rng rng(key.with(pipeline[i].name).with(i));
    result.estimate.figures.clear();
    try {
      result.estimate = pipeline[i].step->advance(result.estimate, rng);
    } catch (const std::logic_error&) {
      throw;
    } catch (const std::exception& error) {
      result.failure = pipeline[i].name + ": " + error.what();
    }
    result.records.push_back(
        {pipeline[i].name, own_seconds(step_start, shared_before), result.estimate.figures});
    if (!result.failure.empty()) break;
  }
  return result;
}

}  // namespace croon

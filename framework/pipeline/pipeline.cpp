#include "framework/pipeline/pipeline.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "framework/pipeline/own_time.hpp"
#include "framework/stage/reasons.hpp"

namespace croon {

nlohmann::ordered_json pipeline_json(const Pipeline& pipeline) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const NamedStep& named : pipeline) {
    nlohmann::ordered_json step = {{"name", named.name}};
    step.update(nlohmann::ordered_json::parse(named.step.resolved()));
    list.push_back(std::move(step));
  }
  return list;
}

void add_notes(const Pipeline& pipeline, std::vector<Fault>& notes) {
  for (const NamedStep& step : pipeline) {
    for (const Fault& note : step.notes) add_note(notes, note);
  }
}

PipelineResult at_start(std::shared_ptr<const Cloud> target, std::shared_ptr<const Cloud> source,
                        const RigidTransform& start) {
  PipelineResult result;
  result.estimate.target = std::move(target);
  result.estimate.source = std::move(source);
  result.estimate.T_target_source = start;
  result.estimate.initial_guess = start;
  return result;
}

void advance(PipelineResult& result, const NamedStep& named, const StreamKey& key) {
  if (!result.failure.empty()) return;
  const auto& [name, step, notes] = named;
  const OwnTime time;
  Rng rng(key.with(name));
  Estimate before = std::move(result.estimate);
  const std::optional<std::string> rejection = std::exchange(before.rejection, std::nullopt);
  const std::optional<Matrix6d> information = std::exchange(before.information, std::nullopt);
  before.diagnostics.clear();
  result.estimate = before;
  try {
    result.estimate = step->advance(std::move(before), rng);
  } catch (const StageError& error) {
    result.failure = name + ": " + error.what();
  }
  Estimate& after = result.estimate;
  result.records.push_back({name, time.seconds(), after.diagnostics, after.information});
  if (!after.information) after.information = information;
  if (after.rejection) {
    after.rejection = with_reason(rejection, name + ": " + *after.rejection);
  } else {
    after.rejection = rejection;
  }
}

PipelineResult run_pipeline(const Pipeline& pipeline, std::shared_ptr<const Cloud> target,
                            std::shared_ptr<const Cloud> source, const RigidTransform& start,
                            const StreamKey& key) {
  PipelineResult result = at_start(std::move(target), std::move(source), start);
  for (const NamedStep& step : pipeline) advance(result, step, key);
  return result;
}

}  // namespace croon

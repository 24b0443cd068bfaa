#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/params/slot.hpp"
#include "framework/stage/step.hpp"

namespace croon {

/// A step and its name in variants, reports and timings.
struct NamedStep {
  std::string name;
  params::Slot<Step> step;
  std::vector<Fault> notes = {};  ///< Former names of keys in its JSON.
};

/// The steps of a method, in order.
using Pipeline = std::vector<NamedStep>;

/// Canonical JSON of the pipeline: its steps with their names and all their parameters.
nlohmann::ordered_json pipeline_json(const Pipeline& pipeline);

/// Appends the notes on the steps of `pipeline` to `notes`, each message once.
void add_notes(const Pipeline& pipeline, std::vector<Fault>& notes);

/// The record of one step of one trial.
struct StepRecord {
  std::string name;
  double seconds = 0.0;  ///< Its own time, without shared work for all trials.
  std::vector<Diagnostic> diagnostics;
  std::optional<Matrix6d> information;  ///< If this step computed one, see Estimate.
};

/// The state of one trial after some of its steps.
struct PipelineResult {
  Estimate estimate;    ///< Of the last step that did not fail.
  std::string failure;  ///< Empty, or the step that failed and the reason.
  std::vector<StepRecord> records;
  std::string note = {};  ///< Optional remark.
};

/// The state before the first step.
PipelineResult at_start(std::shared_ptr<const Cloud> target, std::shared_ptr<const Cloud> source,
                        const RigidTransform& start);

/// Applies one step to `result`; does nothing if an earlier step failed. Each step draws from its
/// own stream, named by `key` and its name, so that adding or removing a step does not change the
/// draws of others. A StageError ends the trial and becomes its `failure`; any other exception is
/// passed on (see `with_stage_errors` for those of libraries).
void advance(PipelineResult& result, const NamedStep& step, const StreamKey& key);

/// Applies the steps of `pipeline` to `start`.
PipelineResult run_pipeline(const Pipeline& pipeline, std::shared_ptr<const Cloud> target,
                            std::shared_ptr<const Cloud> source, const RigidTransform& start,
                            const StreamKey& key);

}  // namespace croon

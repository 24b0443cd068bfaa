#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/params/slot.hpp"
#include "framework/stage/step.hpp"

namespace croon {

/// A step and what variants, reports and timings call it.
struct NamedStep {
  std::string name;
  params::Slot<Step> step;
};

/// The steps of a method, in order.
using Pipeline = std::vector<NamedStep>;

/// What one step of one trial did.
struct StepRecord {
  std::string name;
  double seconds = 0.0;  ///< Its own, without what was made once for all trials.
  std::vector<StepFigure> figures;
  std::optional<Matrix6d> information;  ///< Where this step found one, see Estimate.
};

/// What became of one start so far.
struct PipelineResult {
  Estimate estimate;    ///< The last good one.
  std::string failure;  ///< Empty, or which step was defeated and why.
  std::vector<StepRecord> records;
};

/// A start before its first step.
PipelineResult at_start(std::shared_ptr<const Cloud> target, std::shared_ptr<const Cloud> source,
                        const RigidTransform& start);

/// Takes `result` one step further; does nothing if an earlier step failed. Each step draws from a
/// stream of its own, named by `key` and its name, so one step's draws do not move another's and a
/// step that is removed moves none. A StageError ends the trial and becomes its `failure`; any
/// other exception passes through (see `with_stage_errors` for those of libraries).
void advance(PipelineResult& result, const NamedStep& step, const StreamKey& key);

/// Takes `start` through the steps of `pipeline`.
PipelineResult run_pipeline(const Pipeline& pipeline, std::shared_ptr<const Cloud> target,
                            std::shared_ptr<const Cloud> source, const RigidTransform& start,
                            const StreamKey& key);

}  // namespace croon

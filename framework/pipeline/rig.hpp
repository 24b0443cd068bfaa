#pragma once

#include <string>
#include <vector>

#include "framework/pipeline/pipeline.hpp"

namespace croon {

/// One sensor in one scene of a trial, and its current state.
struct RigMember {
  std::string scene;
  std::string target;  ///< The sensor in whose frame the pose is.
  std::string source;  ///< The sensor whose pose is estimated.
  StreamKey key;       ///< Names the random streams of steps that process only this pair.
  PipelineResult result;
};

/// All sensors and scenes of a trial, by scene and then by sensor.
using Rig = std::vector<RigMember>;

/// Whether a step of the pipeline is a RigStep.
bool has_rig_step(const Pipeline& pipeline);

/// Applies one step to all members that have not failed: to each individually and in parallel, or
/// to all at once for a RigStep, which draws from the stream named by `key` and its name and whose
/// time is divided among the members. The same bits for any number of threads.
void advance(Rig& rig, const NamedStep& step, const StreamKey& key);

/// Applies the steps of `pipeline` to the members, each `at_start`.
void run_pipeline(const Pipeline& pipeline, Rig& rig, const StreamKey& key);

/// The result of one sensor, selected from its members: the first that has neither failed nor been
/// rejected, else the first that has not failed, else the first. After a step that sets the same
/// pose in all scenes, it is that pose. The time of a step is the sum over the members; everything
/// else is from the selected one. `members` must not be empty.
PipelineResult result_of_sensor(const std::vector<const RigMember*>& members);

}  // namespace croon

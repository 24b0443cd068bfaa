#pragma once

#include <string>
#include <vector>

#include "framework/pipeline/pipeline.hpp"

namespace croon {

/// One sensor in one scene of a trial, and how far it has come.
struct RigMember {
  std::string scene;
  std::string target;  ///< The sensor in whose frame the pose is.
  std::string source;  ///< The sensor whose pose is estimated.
  StreamKey key;       ///< Names the random streams of steps that see this pair alone.
  PipelineResult result;
};

/// All sensors and scenes of a trial, by scene and then by sensor.
using Rig = std::vector<RigMember>;

/// Whether a step of the pipeline is a RigStep.
bool has_rig_step(const Pipeline& pipeline);

/// Takes all members that have not failed one step further: each by itself and in parallel, or all
/// at once by a RigStep, which draws from the stream that `key` and its name give. Its time is
/// divided among the members. The same bits for any number of threads.
void advance(Rig& rig, const NamedStep& step, const StreamKey& key);

/// Takes the members, each `at_start`, through the steps of `pipeline`.
void run_pipeline(const Pipeline& pipeline, Rig& rig, const StreamKey& key);

/// The result of one sensor, from its members: the first that has neither failed nor been rejected,
/// else the first that has not failed, else the first. After a step that gives a sensor one pose in
/// all scenes it is that pose. The time of a step is the sum over the members, all else is of one
/// of them. `members` must not be empty.
PipelineResult result_of_sensor(const std::vector<const RigMember*>& members);

}  // namespace croon

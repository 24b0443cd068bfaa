#include "framework/calibration/rig_run.hpp"

#include <tbb/task_arena.h>

#include <algorithm>

#include "framework/base/text.hpp"
#include "framework/base/threads.hpp"
#include "framework/geometry/length_bound.hpp"
#include "framework/pipeline/calibrate.hpp"
#include "framework/stage/rig_step.hpp"

namespace croon {
namespace {

bool sees_rig(const NamedStep& named) {
  return dynamic_cast<const RigStep*>(&*named.step) != nullptr;
}

Rig rig_at_start(const std::vector<CalibrationMember>& members, std::uint64_t seed) {
  Rig rig;
  for (const CalibrationMember& member : members) {
    rig.push_back(
        {member.scene, member.reference, member.sensor,
         trial_stream({seed, member.scene, member.reference, member.sensor, 0}),
         at_start(member.target, member.source, member.start.value_or(RigidTransform()))});
  }
  return rig;
}

/// Whether a step has set this sensor to the same pose in more than one scene.
bool has_common_pose(const Rig& rig, std::size_t index) {
  const RigidTransform& T = rig[index].result.estimate.T_target_source;
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const Estimate& other = rig[i].result.estimate;
    if (i == index || rig[i].source != rig[index].source) continue;
    if (!rig[i].result.failure.empty()) continue;
    if (other.T_target_source == T) return true;
  }
  return false;
}

bool has_any_common_pose(const Rig& rig) {
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const PipelineResult& result = rig[i].result;
    const bool is_live = result.failure.empty() && !result.estimate.rejection;
    if (is_live && has_common_pose(rig, i)) return true;
  }
  return false;
}

/// Adds the poses of the members that `step` has changed to their paths.
void extend(std::vector<std::vector<StepPose>>& paths, const Rig& rig,
            const std::vector<CalibrationMember>& members, const std::string& step) {
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const RigidTransform& T = rig[i].result.estimate.T_target_source;
    const RigidTransform last = paths[i].empty() ? members[i].start.value_or(RigidTransform())
                                                 : paths[i].back().T_reference_sensor;
    if (T != last && why_unusable(rig[i].result.estimate).empty()) paths[i].push_back({step, T});
  }
}

/// `before_common` contains the estimates that preceded the step that set each sensor to one pose
/// in all scenes; it is empty if there was no such step.
std::vector<MemberResult> results_of(const std::vector<CalibrationMember>& members, const Rig& rig,
                                     const std::vector<Estimate>& before_common,
                                     std::vector<std::vector<StepPose>> paths) {
  std::vector<MemberResult> results;
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const PipelineResult& end = rig[i].result;
    const bool is_common = !before_common.empty() && has_common_pose(rig, i);
    const Estimate& in_scene = is_common ? before_common[i] : end.estimate;
    MemberResult result{end.estimate, end.failure, in_scene.T_target_source, in_scene.covariance};
    const std::string why_not = why_unusable(end.estimate);
    if (result.failure.empty()) result.failure = why_not;
    const bool is_moved = result.T_in_scene != members[i].start.value_or(RigidTransform());
    result.has_pose = why_not.empty() && (end.failure.empty() || is_moved);
    result.path = std::move(paths[i]);
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace

std::string why_unusable(const Estimate& estimate) {
  const RigidTransform& T = estimate.T_target_source;
  if (!T.rotation.allFinite() || !T.translation.allFinite()) return "the pose is not finite";
  if (T.translation.cwiseAbs().maxCoeff() > kMaxPoseDistance_m) {
    return "the distance of the pose exceeds " + fixed_number(kMaxPoseDistance_m, 0) + " m";
  }
  if (!is_rotation_matrix(T.rotation)) {
    return "the rotation of the pose is invalid: the columns of its matrix are not orthonormal";
  }
  if (estimate.covariance && !is_covariance(estimate.covariance->matrix)) {
    return "invalid covariance: not symmetric, finite and positive semi-definite";
  }
  return "";
}

std::vector<MemberResult> run_rig(const Composition& composition,
                                  const std::vector<CalibrationMember>& members, std::uint64_t seed,
                                  const StepProgress& progress) {
  Rig rig = rig_at_start(members, seed);
  const StreamKey key = StreamKey(seed).with("rig").with("calibration").with(std::uint64_t{0});
  std::vector<Estimate> before_common;
  std::vector<std::vector<StepPose>> paths(rig.size());
  for (std::size_t s = 0; s < composition.from_nothing.size(); ++s) {
    const NamedStep& step = composition.from_nothing[s];
    progress(step.name,
             static_cast<double>(s) / static_cast<double>(composition.from_nothing.size()));
    if (sees_rig(step)) {
      std::vector<Estimate> before;
      for (const RigMember& member : rig) before.push_back(member.result.estimate);
      advance(rig, step, key);
      if (before_common.empty() && has_any_common_pose(rig)) before_common = std::move(before);
      extend(paths, rig, members, step.name);
      continue;
    }
    for_each_in_parallel(rig.size(), [&](std::size_t i) {
      const NamedStep& own = members[i].start ? composition.near_nominal[s] : step;
      tbb::this_task_arena::isolate([&] { advance(rig[i].result, own, rig[i].key); });
    });
    extend(paths, rig, members, step.name);
  }
  return results_of(members, rig, before_common, std::move(paths));
}

}  // namespace croon

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

/// The index of the last step that sees the rig; the number of steps if there is none.
std::size_t last_rig_step(const Pipeline& pipeline) {
  for (std::size_t i = pipeline.size(); i-- > 0;) {
    if (sees_rig(pipeline[i])) return i;
  }
  return pipeline.size();
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

/// Why the pose of an estimate is not usable; empty if it is.
std::string why_unusable(const Estimate& estimate) {
  const RigidTransform& T = estimate.T_target_source;
  if (!T.rotation.allFinite() || !T.translation.allFinite()) return "the pose is not finite";
  if (T.translation.cwiseAbs().maxCoeff() > kLargestDistance_m) return "the pose is too far away";
  if (!is_rotation_matrix(T.rotation)) return "the pose has no rotation";
  if (estimate.covariance && !is_covariance(estimate.covariance->matrix)) {
    return "the covariance is not symmetric, finite and positive semi-definite";
  }
  return "";
}

/// Whether a step has given this sensor the same pose in more than one scene.
bool has_common_pose(const Rig& rig, std::size_t index) {
  const RigidTransform& T = rig[index].result.estimate.T_target_source;
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const Estimate& other = rig[i].result.estimate;
    if (i == index || rig[i].source != rig[index].source) continue;
    if (!rig[i].result.failure.empty() || other.rejection) continue;
    if (other.T_target_source.rotation == T.rotation &&
        other.T_target_source.translation == T.translation) {
      return true;
    }
  }
  return false;
}

std::vector<MemberResult> results_of(Rig rig, const std::vector<Estimate>& before) {
  std::vector<MemberResult> results;
  for (std::size_t i = 0; i < rig.size(); ++i) {
    const PipelineResult& end = rig[i].result;
    const bool is_common = !before.empty() && has_common_pose(rig, i);
    const Estimate& in_scene = is_common ? before[i] : end.estimate;
    results.push_back({end.estimate, end.failure, in_scene.T_target_source, in_scene.covariance});
    if (end.failure.empty()) results.back().failure = why_unusable(end.estimate);
  }
  return results;
}

}  // namespace

std::vector<MemberResult> run_rig(const Composition& composition,
                                  const std::vector<CalibrationMember>& members, std::uint64_t seed,
                                  const StepProgress& progress) {
  Rig rig = rig_at_start(members, seed);
  const StreamKey key = StreamKey(seed).with("rig").with("calibration").with(std::uint64_t{0});
  const std::size_t last = last_rig_step(composition.from_nothing);
  std::vector<Estimate> before;
  for (std::size_t s = 0; s < composition.from_nothing.size(); ++s) {
    const NamedStep& step = composition.from_nothing[s];
    progress(step.name,
             static_cast<double>(s) / static_cast<double>(composition.from_nothing.size()));
    if (s == last) {
      for (const RigMember& member : rig) before.push_back(member.result.estimate);
    }
    if (sees_rig(step)) {
      advance(rig, step, key);
      continue;
    }
    for_each_in_parallel(rig.size(), [&](std::size_t i) {
      const NamedStep& own = members[i].start ? composition.near_nominal[s] : step;
      tbb::this_task_arena::isolate([&] { advance(rig[i].result, own, rig[i].key); });
    });
  }
  return results_of(std::move(rig), before);
}

}  // namespace croon

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/composition.hpp"
#include "framework/pipeline/rig.hpp"

namespace croon {

/// One sensor in one scene, as input of a calibration.
struct CalibrationMember {
  std::string scene, reference, sensor;
  std::shared_ptr<const Cloud> target, source;
  std::optional<RigidTransform> start = {};  ///< A nominal pose as the initial guess.
};

/// The result for one sensor in one scene.
struct MemberResult {
  Estimate estimate;
  std::string failure;  ///< The step that failed and the reason; empty if none did.
  /// The pose from this scene alone and its covariance: as in `estimate`, unless a step has set the
  /// sensor to one pose in all scenes.
  RigidTransform T_in_scene;
  std::optional<PoseCovariance> covariance_in_scene;
  /// Whether a step found a pose, even if a later step failed.
  bool has_pose = false;
  std::vector<StepPose> path = {};  ///< After each step that changed the pose.

  bool is_accepted() const { return failure.empty() && !estimate.rejection; }
};

/// Called with the name of the next step and the share of completed steps.
using StepProgress = std::function<void(const std::string& step, double done)>;

/// Why the pose or the covariance of `estimate` is not usable; empty if they are.
std::string why_unusable(const Estimate& estimate);

/// Runs the steps of `composition` on the members, all as one rig; members without `start` use
/// Composition::from_nothing. A pose that is not usable (not finite, no valid rotation) is a
/// failure. Bitwise the same result for any number of threads.
std::vector<MemberResult> run_rig(const Composition& composition,
                                  const std::vector<CalibrationMember>& members, std::uint64_t seed,
                                  const StepProgress& progress);

}  // namespace croon

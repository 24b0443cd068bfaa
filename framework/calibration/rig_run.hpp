#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/composition.hpp"
#include "framework/pipeline/rig.hpp"

namespace croon {

/// One sensor in one scene, as a calibration begins with it.
struct CalibrationMember {
  std::string scene, reference, sensor;
  std::shared_ptr<const Cloud> target, source;
  std::optional<RigidTransform> start = {};  ///< A nominal pose to start from.
};

/// How one sensor in one scene ended.
struct MemberResult {
  Estimate estimate;
  std::string failure;  ///< Empty, or the step that failed and why.
  /// The pose from this scene alone and its covariance: as in `estimate`, unless a step has given
  /// the sensor one pose in all scenes.
  RigidTransform T_in_scene;
  std::optional<PoseCovariance> covariance_in_scene;
  /// Whether a step has found a pose, be it before another one failed.
  bool has_pose = false;

  bool is_accepted() const { return failure.empty() && !estimate.rejection; }
};

/// Called with the name of the next step and the share of the steps that is done.
using StepProgress = std::function<void(const std::string& step, double done)>;

/// Why the pose of `estimate` or its covariance cannot be used; empty if they can.
std::string why_unusable(const Estimate& estimate);

/// Takes the members through the steps of `composition`, all as one rig; those without a start
/// through Composition::from_nothing. A pose that is not usable (not finite, no rotation) is a
/// failure. The same bits for any number of threads.
std::vector<MemberResult> run_rig(const Composition& composition,
                                  const std::vector<CalibrationMember>& members, std::uint64_t seed,
                                  const StepProgress& progress);

}  // namespace croon

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/calibration/calibrated_rig.hpp"
#include "framework/geometry/dof.hpp"

namespace croon {

/// The judgement of a given pose by the clouds.
enum class PoseJudgement {
  right,       ///< The pose equals the optimum within its uncertainty.
  wrong,       ///< The optimum is elsewhere.
  undecidable  ///< The clouds do not determine it.
};

/// "right", "wrong", "undecidable".
const char* name_of(PoseJudgement judgement);

/// Standard deviations that are added, per axis, to those of a calibration: on real vehicles, poses
/// from different scenes differ by more than their covariances predict.
inline constexpr double kScatter_rad = rad_from_deg(0.05);
inline constexpr double kScatter_m = 0.005;

/// Mahalanobis distance above which a given pose is wrong: with six degrees of freedom, chance
/// exceeds it as rarely as four standard deviations with one.
inline constexpr double kWrongDistance = 5.4;

/// A given pose compared with the optimum that a calibration found.
struct CheckedSensor {
  std::string sensor;
  PoseJudgement judgement = PoseJudgement::undecidable;
  std::optional<RigidTransform> given;    ///< T_reference_sensor; std::nullopt if there is none.
  std::optional<RigidTransform> optimum;  ///< T_reference_sensor; std::nullopt if unknown.
  /// If both exist: the `pose_error` of the given pose from the optimum, rad and m; its standard
  /// deviations including the scatter of real scenes; and the Mahalanobis distance.
  Vector6d difference = Vector6d::Zero(), deviations = Vector6d::Zero();
  double distance = 0.0;
  std::string finding;               ///< One sentence that explains the judgement.
  std::vector<std::string> reasons;  ///< Why there is no optimum; otherwise empty.
};

/// Judges CalibratedSensor::nominal, the given pose, by two calibrations of the same clouds:
/// without an initial guess and, if that was rejected, with the search near the given pose. An
/// accepted pose of the former decides. A pose that is accepted only near the given one may be one
/// of several that explain the clouds, so it can only show that the given pose is wrong.
CheckedSensor check_sensor(const CalibratedSensor& from_nothing,
                           const CalibratedSensor* near_given = nullptr);

/// The same for all sensors of a rig, in the order of `from_nothing`.
std::vector<CheckedSensor> check_rig(const CalibratedRig& from_nothing,
                                     const std::optional<CalibratedRig>& near_given);

}  // namespace croon

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/calibration/calibrated_rig.hpp"
#include "framework/geometry/dof.hpp"

namespace croon {

/// What the clouds say about a given pose.
enum class PoseJudgement {
  right,       ///< The pose is the optimum, within what is known of it.
  wrong,       ///< The optimum is elsewhere.
  undecidable  ///< The clouds do not tell.
};

/// "right", "wrong", "undecidable".
const char* name_of(PoseJudgement judgement);

/// Standard deviations that are added to those of a calibration, per axis: on real vehicles,
/// poses from different scenes differ by more than their covariances say.
inline constexpr double kScatter_rad = rad_from_deg(0.05);
inline constexpr double kScatter_m = 0.005;

/// A given pose is wrong from this Mahalanobis distance on: with six degrees of freedom it is
/// exceeded by chance as rarely as four standard deviations are with one.
inline constexpr double kWrongDistance = 5.4;

/// A given pose against the optimum that a calibration has found.
struct CheckedSensor {
  std::string sensor;
  PoseJudgement judgement = PoseJudgement::undecidable;
  std::optional<RigidTransform> given;    ///< T_reference_sensor; std::nullopt if there is none.
  std::optional<RigidTransform> optimum;  ///< T_reference_sensor; std::nullopt if it is not known.
  /// If there are both: given from optimum as `pose_error` measures it, rad and m; its standard
  /// deviations with the scatter of real scenes; and the Mahalanobis distance.
  Vector6d difference = Vector6d::Zero(), deviations = Vector6d::Zero();
  double distance = 0.0;
  std::string finding;               ///< One sentence for the judgement.
  std::vector<std::string> reasons;  ///< Why there is no optimum; else empty.
};

/// Judges CalibratedSensor::nominal, the given pose, by two calibrations of the same clouds: from
/// nothing, and if that was rejected, with the search near the given pose. An accepted pose from
/// nothing decides. A pose that is accepted near the given one alone may be one of several that
/// explain the clouds: it can only show that the given pose is wrong.
CheckedSensor check_sensor(const CalibratedSensor& from_nothing,
                           const CalibratedSensor* near_given = nullptr);

/// The same for all sensors of a rig, in the order of `from_nothing`.
std::vector<CheckedSensor> check_rig(const CalibratedRig& from_nothing,
                                     const std::optional<CalibratedRig>& near_given);

}  // namespace croon

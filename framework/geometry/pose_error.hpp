#pragma once

#include "framework/geometry/dof.hpp"

namespace croon {

/// How far an estimate of `T_reference_sensor` is from the truth, in the reference frame (as in the
/// paper's tables): roll, pitch, yaw of `T_estimate * T_truth^-1`, and the difference of the
/// translations.
struct PoseError {
  Vector6d dof = Vector6d::Zero();  ///< roll, pitch, yaw in rad; x, y, z in m.
  double rotation_rad = 0.0;        ///< The angle of the rotation between the two.
  double translation_m = 0.0;       ///< The distance between the two origins.
};

PoseError pose_error(const RigidTransform& estimate, const RigidTransform& truth);

}  // namespace croon

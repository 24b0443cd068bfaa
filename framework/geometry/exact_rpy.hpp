#pragma once

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// (roll, pitch, yaw) in radians whose `rotation_from_rpy` is `rotation` to 1e-12, also near a
/// pitch of 90 degrees, where roll and yaw of rpy_from_rotation lose digits independently of each
/// other. Elsewhere the same bits.
Eigen::Vector3d exact_rpy(const Eigen::Matrix3d& rotation);

}  // namespace croon

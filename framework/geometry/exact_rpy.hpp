#pragma once

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// (roll, pitch, yaw) in radians whose `rotation_from_rpy` equals `rotation` to 1e-12, even near a
/// pitch of 90 degrees, where rpy_from_rotation loses digits of roll and yaw independently of each
/// other. Elsewhere it returns the same bits as rpy_from_rotation.
Eigen::Vector3d exact_rpy(const Eigen::Matrix3d& rotation);

}  // namespace croon

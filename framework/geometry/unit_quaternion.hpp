#pragma once

#include <Eigen/Geometry>

namespace croon {

/// The quaternion of a rotation with the sign that files use: of `q` and `-q` the one whose first
/// coefficient in the order w, x, y, z that is not zero is positive.
Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& rotation);

}  // namespace croon

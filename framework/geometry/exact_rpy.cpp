#include "framework/geometry/exact_rpy.hpp"

#include <cmath>

namespace croon {

Eigen::Vector3d exact_rpy(const Eigen::Matrix3d& rotation) {
  constexpr double kMinCosPitch = 1e-3;
  if (std::hypot(rotation(0, 0), rotation(1, 0)) > kMinCosPitch) return rpy_from_rotation(rotation);
  const double roll = std::atan2(rotation(2, 1), rotation(2, 2));
  // Without Rx, Rz Ry remains, whatever the error of the roll.
  const Eigen::Matrix3d rest = rotation * rotation_from_rpy({roll, 0.0, 0.0}).transpose();
  return {roll, std::atan2(-rest(2, 0), rest(2, 2)), std::atan2(-rest(0, 1), rest(1, 1))};
}

}  // namespace croon

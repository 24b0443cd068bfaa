#include "framework/geometry/unit_quaternion.hpp"

namespace croon {

Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  for (const double coefficient : {q.w(), q.x(), q.y(), q.z()}) {
    if (coefficient == 0.0) continue;
    return coefficient > 0.0 ? q : Eigen::Quaterniond(-q.coeffs());
  }
  return q;
}

}  // namespace croon

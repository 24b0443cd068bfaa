#include "framework/geometry/twist.hpp"

#include <cmath>

namespace croon {

Vector6d vector_of(const Twist& velocity) {
  Vector6d vector;
  vector << velocity.angular_radps, velocity.linear_mps;
  return vector;
}

Twist stepped(const Twist& velocity, const Vector6d& step) {
  return {velocity.angular_radps + step.head<3>(), velocity.linear_mps + step.tail<3>()};
}

RigidTransform motion_over(const Twist& velocity, double time_s) {
  const Eigen::Vector3d turn_rad = velocity.angular_radps * time_s;
  const Eigen::Vector3d way_m = velocity.linear_mps * time_s;
  const double angle = turn_rad.norm();
  // V = I + a K + b K^2 with K the cross product with `turn_rad`. Below this angle the first terms
  // of the series are exact in double precision.
  double a = 0.5 - angle * angle / 24.0;
  double b = 1.0 / 6.0 - angle * angle / 120.0;
  if (angle > 1e-4) {
    a = (1.0 - std::cos(angle)) / (angle * angle);
    b = (angle - std::sin(angle)) / (angle * angle * angle);
  }
  const Eigen::Vector3d once = turn_rad.cross(way_m);
  return {rotation_exp(turn_rad), way_m + a * once + b * turn_rad.cross(once)};
}

Twist velocity_in(const RigidTransform& T_a_b, const Twist& velocity_b) {
  const Eigen::Vector3d angular = T_a_b.rotation * velocity_b.angular_radps;
  return {angular, T_a_b.rotation * velocity_b.linear_mps + T_a_b.translation.cross(angular)};
}

}  // namespace croon

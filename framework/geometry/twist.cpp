#include "framework/geometry/twist.hpp"

#include <cmath>

namespace croon {
namespace {

/// With K the cross product matrix of the angle times its axis, the rotation is `I + a K + b K^2`
/// and the translation `(I + b K + c K^2)` times the path.
struct Shares {
  double a, b, c;
};

/// The coefficients for the angle x whose square is `square_rad2`: sin x / x, (1 - cos x) / x^2 and
/// (x - sin x) / x^3.
Shares shares_of(double square_rad2) {
  // Up to here, kTerms terms of the series are exact to double precision. A scan rotates by less
  // and has a different time, hence a different angle, for nearly every point; sine and cosine are
  // slower.
  constexpr double kSeries_rad2 = 0.25;
  constexpr int kTerms = 7;
  if (square_rad2 > kSeries_rad2) {
    const double angle = std::sqrt(square_rad2);
    const double sine = std::sin(angle);
    return {sine / angle, (1.0 - std::cos(angle)) / square_rad2,
            (angle - sine) / (angle * square_rad2)};
  }
  // Horner's method: each sum is 1/n! of the series 1 - x^2 / ((n+1)(n+2)) (1 - ...).
  Shares shares = {1.0, 1.0, 1.0};
  for (int k = 2 * (kTerms - 1); k > 0; k -= 2) {
    shares.a = 1.0 - square_rad2 * (1.0 / (k * (k + 1))) * shares.a;
    shares.b = 1.0 - square_rad2 * (1.0 / ((k + 1) * (k + 2))) * shares.b;
    shares.c = 1.0 - square_rad2 * (1.0 / ((k + 2) * (k + 3))) * shares.c;
  }
  return {shares.a, shares.b / 2.0, shares.c / 6.0};
}

}  // namespace

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

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
  const Shares shares = shares_of(turn_rad.squaredNorm());
  const Eigen::Matrix3d K = cross_matrix(turn_rad);
  const Eigen::Vector3d once = turn_rad.cross(way_m);
  return {Eigen::Matrix3d::Identity() + shares.a * K + shares.b * (K * K),
          way_m + shares.b * once + shares.c * turn_rad.cross(once)};
}

Twist velocity_in(const RigidTransform& T_a_b, const Twist& velocity_b) {
  const Eigen::Vector3d angular = T_a_b.rotation * velocity_b.angular_radps;
  return {angular, T_a_b.rotation * velocity_b.linear_mps + T_a_b.translation.cross(angular)};
}

Matrix6d adjoint(const RigidTransform& T_a_b) {
  Matrix6d columns;
  for (int i = 0; i < 6; ++i) {
    columns.col(i) = vector_of(velocity_in(T_a_b, stepped(Twist{}, Vector6d::Unit(i))));
  }
  return columns;
}

}  // namespace croon

#include "framework/stage/velocity_numbers.hpp"

#include "framework/base/angles.hpp"

namespace croon {

const std::array<VelocityNumber, 6>& velocity_numbers() {
  static const std::array<VelocityNumber, 6> numbers = {{
      {"vx", "mps", [](const Twist& v) { return v.linear_mps.x(); }},
      {"vy", "mps", [](const Twist& v) { return v.linear_mps.y(); }},
      {"vz", "mps", [](const Twist& v) { return v.linear_mps.z(); }},
      {"roll_rate", "degps", [](const Twist& v) { return deg_from_rad(v.angular_radps.x()); }},
      {"pitch_rate", "degps", [](const Twist& v) { return deg_from_rad(v.angular_radps.y()); }},
      {"yaw_rate", "degps", [](const Twist& v) { return deg_from_rad(v.angular_radps.z()); }},
  }};
  return numbers;
}

std::vector<Diagnostic> velocity_diagnostics(const Twist& velocity) {
  std::vector<Diagnostic> diagnostics = {
      {"speed_mps", velocity.linear_mps.norm()},
      {"turn_degps", deg_from_rad(velocity.angular_radps.norm())}};
  for (const VelocityNumber& number : velocity_numbers()) {
    diagnostics.emplace_back(number.column(), number.of(velocity));
  }
  return diagnostics;
}

std::vector<Diagnostic> velocity_std_diagnostics(const Matrix6d& covariance) {
  const Vector6d variances = covariance.diagonal();
  const Twist stds = {variances.head<3>().cwiseSqrt(), variances.tail<3>().cwiseSqrt()};
  std::vector<Diagnostic> diagnostics;
  for (const VelocityNumber& number : velocity_numbers()) {
    diagnostics.emplace_back(number.std_column(), number.of(stds));
  }
  return diagnostics;
}

}  // namespace croon

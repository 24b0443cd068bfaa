#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/geometry/twist.hpp"
#include "framework/stage/step.hpp"

namespace croon {

/// One number of a velocity, as files and diagnostics have it.
struct VelocityNumber {
  const char* name;  ///< "yaw_rate".
  const char* unit;  ///< "degps".
  double (*of)(const Twist& velocity);

  std::string column() const { return std::string(name) + "_" + unit; }
  std::string std_column() const { return std::string(name) + "_std_" + unit; }
};

/// Along x, y, z of the body's frame, then about them.
const std::array<VelocityNumber, 6>& velocity_numbers();

/// What a step reports of the velocity that it estimated or knew, that of the target's sensor: how
/// fast it moves and turns, and its six numbers.
std::vector<Diagnostic> velocity_diagnostics(const Twist& velocity);

/// The standard deviations of the six numbers, from the `covariance` of a velocity: about the axes
/// in rad/s, along them in m/s.
std::vector<Diagnostic> velocity_std_diagnostics(const Matrix6d& covariance);

}  // namespace croon

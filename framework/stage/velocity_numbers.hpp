#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/geometry/twist.hpp"
#include "framework/stage/step.hpp"

namespace croon {

/// One component of a velocity, as named in files and diagnostics.
struct VelocityNumber {
  const char* name;  ///< "yaw_rate".
  const char* unit;  ///< "degps".
  double (*of)(const Twist& velocity);

  std::string column() const { return std::string(name) + "_" + unit; }
  std::string std_column() const { return std::string(name) + "_std_" + unit; }
};

/// The components along x, y, z of the body's frame, then about them.
const std::array<VelocityNumber, 6>& velocity_numbers();

/// The diagnostics of a step for the estimated or known velocity of the target's sensor: its speed
/// and rate of rotation, and its six components.
std::vector<Diagnostic> velocity_diagnostics(const Twist& velocity);

/// The standard deviations of the six components, from the `covariance` of a velocity: about the
/// axes in rad/s, along them in m/s.
std::vector<Diagnostic> velocity_std_diagnostics(const Matrix6d& covariance);

}  // namespace croon

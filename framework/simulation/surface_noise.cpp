#include "framework/simulation/surface_noise.hpp"

#include <cmath>
#include <cstdint>

namespace croon::simulation {
namespace {

/// Uniform with a standard deviation of 1, from the corner (i, j) alone.
double corner_value(const StreamKey& key, std::int64_t i, std::int64_t j) {
  const std::uint64_t bits =
      key.with(static_cast<std::uint64_t>(i)).with(static_cast<std::uint64_t>(j)).value();
  const double uniform = static_cast<double>(bits >> 11) * 0x1.0p-53;
  return std::sqrt(12.0) * (uniform - 0.5);
}

/// From 0 to 1 with level ends (3 t^2 - 2 t^3).
double smooth(double t) { return t * t * (3.0 - 2.0 * t); }

}  // namespace

double surface_noise(const StreamKey& key, double s_m, double d_m, double wavelength_m) {
  const double u = s_m / wavelength_m;
  const double v = d_m / wavelength_m;
  const double i = std::floor(u);
  const double j = std::floor(v);
  const auto corner = [&](int di, int dj) {
    return corner_value(key, static_cast<std::int64_t>(i) + di, static_cast<std::int64_t>(j) + dj);
  };
  const double a = smooth(u - i);
  const double b = smooth(v - j);
  const double near = (1.0 - a) * corner(0, 0) + a * corner(1, 0);
  const double far = (1.0 - a) * corner(0, 1) + a * corner(1, 1);
  // The blend halves the variance twice in the middle of a cell; 1.4 makes up for it on average.
  return 1.4 * ((1.0 - b) * near + b * far);
}

}  // namespace croon::simulation

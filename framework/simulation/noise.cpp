#include "framework/simulation/noise.hpp"

#include <cmath>

namespace croon::simulation {

Noise carla_noise() {
  Noise noise;
  noise.dropout_ratio = 0.156;
  return noise;
}

Noise real_noise() {
  Noise noise;
  noise.range_std_m = 0.02;
  noise.angle_std_deg = 0.02;
  noise.dropout_ratio = 0.005;
  noise.detection_range_m = 200.0;
  noise.sweep_distortion = true;
  return noise;
}

double detection_probability(const Noise& noise, double range_m, double signal_ratio) {
  constexpr double kTarget = 0.1;
  constexpr double kSteepness = 8.0;  // From nearly all to nearly none within a factor of two.
  if (noise.detection_range_m <= 0.0) return 1.0;
  const double half_m = noise.detection_range_m * std::sqrt(signal_ratio / kTarget);
  if (half_m <= 0.0) return 0.0;
  return 1.0 / (1.0 + std::pow(range_m / half_m, kSteepness));
}

}  // namespace croon::simulation

#include "framework/simulation/sensor_model.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

/// `count` evenly spaced angles from `from_deg` to `to_deg`, both included.
std::vector<double> evenly(double from_deg, double to_deg, int count) {
  std::vector<double> angles;
  for (int i = 0; i < count; ++i)
    angles.push_back(from_deg + (to_deg - from_deg) * i / (count - 1));
  return angles;
}

/// Hesai's Pandar64: rings a sixth of a degree apart from -6 to 2 degrees, coarser towards both
/// ends (from the user manual and the paper's real samples).
std::vector<double> pandar64_elevations() {
  std::vector<double> rings = {-24.9, -18.9};
  for (const double deg : evenly(-13.95, -7.05, 8)) rings.push_back(deg);
  for (const double deg : evenly(-6.06, 2.03, 49)) rings.push_back(deg);
  for (const double deg : {3.04, 5.06, 8.06, 11.03, 14.88}) rings.push_back(deg);
  return rings;
}

/// Hesai's PandarQT: 64 rings over 104 degrees, 1.45 degrees apart in the middle and 2.3 at the
/// ends. The polynomial is within 0.02 degrees of the rings of the paper's samples.
std::vector<double> pandar_qt_elevations() {
  std::vector<double> rings;
  for (int ring = 0; ring < 64; ++ring) {
    const double i = ring - 31.5;
    const double i2 = i * i;
    rings.push_back(i * (1.447908 + i2 * (1.411600e-4 + i2 * (-2.207753e-8 + i2 * 9.041185e-11))));
  }
  return rings;
}

SensorModel spinner(std::vector<double> elevations_deg, double azimuth_step_deg, double min_range_m,
                    double max_range_m) {
  SensorModel sensor;
  sensor.elevations_deg = std::move(elevations_deg);
  sensor.azimuth_step_deg = azimuth_step_deg;
  sensor.min_range_m = min_range_m;
  sensor.max_range_m = max_range_m;
  return sensor;
}

SensorModel solid_state() {
  SensorModel sensor = spinner(evenly(-12.5, 12.5, 126), 0.2, 0.5, 200.0);
  sensor.azimuth_from_deg = -60.0;
  sensor.azimuth_to_deg = 60.0;
  return sensor;
}

SensorModel rosette(double width_deg, double height_deg, int rays, double period_s) {
  SensorModel sensor = spinner({0.0}, 0.2, 1.0, 200.0);
  sensor.rosette_rays = rays;
  sensor.rosette_width_deg = width_deg;
  sensor.rosette_height_deg = height_deg;
  sensor.period_s = period_s;
  return sensor;
}

std::vector<std::pair<std::string, SensorModel>> make_models() {
  // In the paper's samples, CARLA's sensors have the rings of the real ones, but other ranges.
  return {{"carla_pandar64", spinner(pandar64_elevations(), 0.2, 0.1, 200.0)},
          {"carla_pandar_qt", spinner(pandar_qt_elevations(), 0.6, 0.1, 20.0)},
          {"pandar64", spinner(pandar64_elevations(), 0.2, 1.0, 200.0)},
          {"pandar_qt", spinner(pandar_qt_elevations(), 0.6, 0.3, 30.0)},
          {"spinner_32", spinner(evenly(-30.67, 10.67, 32), 0.2, 0.8, 100.0)},
          {"spinner_16", spinner(evenly(-15.0, 15.0, 16), 0.2, 0.8, 100.0)},
          {"solid_state", solid_state()},
          // 100,000 rays/s like a Livox Mid-40, and 240,000 rays/s like an Avia.
          {"rosette_38", rosette(38.4, 38.4, 40000, 0.4)},
          {"rosette_77", rosette(70.4, 77.2, 24000, 0.1)}};
}

}  // namespace

const std::vector<std::pair<std::string, SensorModel>>& sensor_models() {
  static const std::vector<std::pair<std::string, SensorModel>> models = make_models();
  return models;
}

const SensorModel& sensor_model(const std::string& name) {
  const auto& models = sensor_models();
  const auto found = std::find_if(models.begin(), models.end(),
                                  [&](const auto& model) { return model.first == name; });
  if (found == models.end()) throw std::logic_error("there is no sensor model " + name);
  return found->second;
}

std::vector<double> azimuths_deg(const SensorModel& sensor) {
  const double span_deg = sensor.azimuth_to_deg - sensor.azimuth_from_deg;
  // If the step divides the span up to rounding, there is no ray at the end of the span.
  const auto count = static_cast<int>(std::ceil(span_deg / sensor.azimuth_step_deg - 1e-6));
  std::vector<double> azimuths;
  for (int i = 0; i < count; ++i) {
    azimuths.push_back(sensor.azimuth_from_deg + i * sensor.azimuth_step_deg);
  }
  return azimuths;
}

double ray_count(const SensorModel& sensor) {
  if (sensor.rosette_rays > 0) return sensor.rosette_rays;
  return static_cast<double>(sensor.elevations_deg.size()) *
         (sensor.azimuth_to_deg - sensor.azimuth_from_deg) / sensor.azimuth_step_deg;
}

std::array<double, 2> rosette_angles_rad(const SensorModel& sensor,
                                         const std::array<double, 2>& phases_rad, double time_s) {
  // The speeds of the prisms of a Livox Mid-40, whose ratio makes the petals turn.
  constexpr double kFirst_rpm = 7294.0;
  constexpr double kSecond_rpm = -4664.0;
  const double turn_rad = 2.0 * kPi * time_s / 60.0;
  const double first_rad = phases_rad[0] + kFirst_rpm * turn_rad;
  const double second_rad = phases_rad[1] + kSecond_rpm * turn_rad;
  // The deflection of the beam to the left and upwards; at most half the field of view.
  const double left_rad =
      0.25 * rad_from_deg(sensor.rosette_width_deg) * (std::cos(first_rad) + std::cos(second_rad));
  const double up_rad =
      0.25 * rad_from_deg(sensor.rosette_height_deg) * (std::sin(first_rad) + std::sin(second_rad));
  const double deflection_rad = std::hypot(left_rad, up_rad);
  if (deflection_rad == 0.0) return {0.0, 0.0};
  const double sine_share = std::sin(deflection_rad) / deflection_rad;
  return {std::atan2(sine_share * left_rad, std::cos(deflection_rad)),
          std::asin(std::clamp(sine_share * up_rad, -1.0, 1.0))};
}

Noise carla_noise() {
  Noise noise;
  noise.dropout_ratio = 0.156;
  return noise;
}

Noise real_still_noise() {
  Noise noise;
  noise.range_std_m = 0.02;
  noise.angle_std_deg = 0.02;
  noise.dropout_ratio = 0.005;
  noise.detection_range_m = 200.0;
  return noise;
}

Noise mixed_pixels_noise() {
  Noise noise = real_still_noise();
  noise.footprint_deg = 0.2;
  return noise;
}

Noise real_noise() {
  Noise noise = real_still_noise();
  noise.moves_during_scan = true;
  return noise;
}

double detection_probability(const Noise& noise, double range_m, double signal_ratio) {
  constexpr double kTarget = 0.1;
  // The probability falls from nearly 1 to nearly 0 within a factor of two of the range.
  constexpr double kSteepness = 8.0;
  if (noise.detection_range_m <= 0.0) return 1.0;
  const double half_m = noise.detection_range_m * std::sqrt(signal_ratio / kTarget);
  if (half_m <= 0.0) return 0.0;
  return 1.0 / (1.0 + std::pow(range_m / half_m, kSteepness));
}

}  // namespace croon::simulation

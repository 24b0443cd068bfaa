#pragma once

#include <string>
#include <utility>
#include <vector>

namespace croon::simulation {

/// A LiDAR whose rings have fixed elevations and sweep a range of azimuths. Sensor frame: x
/// forward, y left, z up. Elevations are upwards from the xy plane, azimuths from x towards y.
struct SensorModel {
  std::vector<double> elevations_deg = {0.0};  ///< Of the rings, ring 0 first.
  double azimuth_from_deg = -180.0;
  double azimuth_to_deg = 180.0;  ///< Exclusive.
  double azimuth_step_deg = 0.2;
  double min_range_m = 0.1;
  double max_range_m = 200.0;
  double period_s = 0.1;  ///< Of one scan.
};

/// The named sensors: the Pandar64 and PandarQT as simulated by CARLA for the paper's samples, the
/// real ones, spinning sensors with 32 and 16 rings, and a solid-state sensor.
const std::vector<std::pair<std::string, SensorModel>>& sensor_models();

/// The sensor `name`. Throws std::logic_error if there is none.
const SensorModel& sensor_model(const std::string& name);

/// The azimuths of a scan in the order of firing, degrees.
std::vector<double> azimuths_deg(const SensorModel& sensor);

/// The measurement errors of a sensor. By default there are none, as in the paper's simulation.
struct Noise {
  double range_std_m = 0.0;        ///< Standard deviation of a range.
  double angle_std_deg = 0.0;      ///< Standard deviation of a ray's elevation and azimuth.
  double dropout_ratio = 0.0;      ///< Share of the rays that are lost regardless of the surface.
  double detection_range_m = 0.0;  ///< See detection_probability; 0: all rays return.
  /// Whether bodies move during a scan; otherwise all rays are fired at time 0.
  bool moves_during_scan = false;
  double clock_offset_s = 0.0;  ///< Added to the times of all sensors except the reference.
};

/// The noise of CARLA in the paper's samples: exact points, but 15.6 % of the rays are lost (of the
/// 1800 rays of a ring that hits the ground all around, 1520 return).
Noise carla_noise();

/// The noise of a spinning automotive LiDAR on a stationary car among static objects: 2 cm, 0.02
/// degrees, loss of 0.5 % of the rays, detection of 10 % targets at 200 m.
Noise real_still_noise();

/// The same, but the car and other objects move during a scan.
Noise real_noise();

/// The probability that a ray returns from a surface at `range_m` that reflects the share
/// `signal_ratio` of the light. It is one half for the signal strength of a perpendicular 10 %
/// target at `noise.detection_range_m`; signals decrease with the square of the range.
double detection_probability(const Noise& noise, double range_m, double signal_ratio);

}  // namespace croon::simulation

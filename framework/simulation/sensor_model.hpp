#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace croon::simulation {

/// A LiDAR whose rings have fixed elevations and sweep a range of azimuths, or whose single beam
/// draws a rosette about x. Sensor frame: x
/// forward, y left, z up. Elevations are upwards from the xy plane, azimuths from x towards y.
struct SensorModel {
  std::vector<double> elevations_deg = {0.0};  ///< Of the rings, ring 0 first.
  double azimuth_from_deg = -180.0;
  double azimuth_to_deg = 180.0;  ///< Exclusive.
  double azimuth_step_deg = 0.2;
  /// Rays of a scan along a rosette, instead of rings and azimuths; 0: there is no rosette.
  int rosette_rays = 0;
  double rosette_width_deg = 38.4;  ///< Of the elliptical field of view.
  double rosette_height_deg = 38.4;
  double min_range_m = 0.1;
  double max_range_m = 200.0;
  double period_s = 0.1;  ///< Of one scan.
};

/// The named sensors: the Pandar64 and PandarQT as simulated by CARLA for the paper's samples, the
/// real ones, spinning sensors with 32 and 16 rings, a solid-state sensor, and two with rosettes.
const std::vector<std::pair<std::string, SensorModel>>& sensor_models();

/// The sensor `name`. Throws std::logic_error if there is none.
const SensorModel& sensor_model(const std::string& name);

/// The azimuths of a scan in the order of firing, degrees.
std::vector<double> azimuths_deg(const SensorModel& sensor);

/// The number of rays of a scan.
double ray_count(const SensorModel& sensor);

/// The azimuth and elevation of a rosette at `time_s`, radians. Two prisms deflect the beam by the
/// same angle and rotate in opposite directions from the angles `phases_rad`.
std::array<double, 2> rosette_angles_rad(const SensorModel& sensor,
                                         const std::array<double, 2>& phases_rad, double time_s);

/// The measurement errors of a sensor. By default there are none, as in the paper's simulation.
struct Noise {
  double range_std_m = 0.0;        ///< Standard deviation of a range.
  double angle_std_deg = 0.0;      ///< Standard deviation of a ray's elevation and azimuth.
  double dropout_ratio = 0.0;      ///< Share of the rays that are lost regardless of the surface.
  double detection_range_m = 0.0;  ///< See detection_probability; 0: all rays return.
  /// Diameter of a ray. At an edge between surfaces of similar range, a wide ray returns a range in
  /// between (mixed pixels).
  double footprint_deg = 0.0;
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

/// The same with rays of 0.2 degrees, whose ranges mix at edges.
Noise mixed_pixels_noise();

/// As `real_still_noise`, but the car and other objects move during a scan.
Noise real_noise();

/// The probability that a ray returns from a surface at `range_m` that reflects the share
/// `signal_ratio` of the light. It is one half for the signal strength of a perpendicular 10 %
/// target at `noise.detection_range_m`; signals decrease with the square of the range.
double detection_probability(const Noise& noise, double range_m, double signal_ratio);

}  // namespace croon::simulation

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace croon::simulation {

/// A LiDAR: rays at fixed elevations, swept through a range of azimuths. Sensor frame: x forward,
/// y left, z up; elevation from the xy plane up, azimuth from x towards y.
struct SensorModel {
  std::vector<double> elevations_deg =
      std::vector<double>(1, 0.0);  ///< Of the rings, ring 0 first.
  double azimuth_from_deg = -180.0;
  double azimuth_to_deg = 180.0;  ///< Not itself a ray's azimuth.
  double azimuth_step_deg = 0.2;
  double range_min_m = 0.1;
  double range_max_m = 200.0;
  double period_s = 0.1;  ///< One sweep.
};

/// The sensors that have names: CARLA's Pandar64 and PandarQT as the paper's samples were made
/// with, the real ones, spinners of 32 and 16 rings, a solid-state frustum.
const std::vector<std::pair<std::string, SensorModel>>& sensor_models();

/// The sensor called `name`; std::logic_error where there is none.
const SensorModel& sensor_model(const std::string& name);

/// The azimuths of a sweep in the order of firing, degrees.
std::vector<double> azimuths_deg(const SensorModel& sensor);

}  // namespace croon::simulation

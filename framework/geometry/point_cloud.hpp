#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace croon {

/// Points in the frame of the sensor that took them, in metres, all finite. Float, as a sensor
/// delivers them; poses and sums are double.
using PointCloud = std::vector<Eigen::Vector3f>;

/// A cloud from a file: its finite points in the file's order, and how many were left out because a
/// coordinate is NaN or infinite (or too large for a float).
struct LoadedCloud {
  PointCloud points;
  std::size_t dropped_non_finite = 0;

  /// Takes the point in, or counts it as dropped.
  void add(const Eigen::Vector3d& point) {
    const Eigen::Vector3f rounded = point.cast<float>();
    if (rounded.allFinite()) {
      points.push_back(rounded);
    } else {
      ++dropped_non_finite;
    }
  }
};

/// What a sensor delivers of one sweep: an element of each list per point, in the order of firing.
struct MeasuredCloud {
  PointCloud points;             ///< In the sensor's frame where it was when the ray was fired.
  std::vector<float> intensity;  ///< 0 to 255.
  std::vector<std::uint16_t> ring;
  std::vector<double> time_s;  ///< When the ray was fired.
};

}  // namespace croon

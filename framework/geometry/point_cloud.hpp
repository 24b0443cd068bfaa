#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace croon {

/// Points in the frame of the sensor that measured them, metres, all finite. Float, as sensors
/// deliver them; poses and sums are double.
using PointCloud = std::vector<Eigen::Vector3f>;

/// A cloud from a file: its finite points in the order of the file, and the number of points that
/// were dropped because a coordinate is NaN, infinite or too large for a float.
struct LoadedCloud {
  PointCloud points;
  std::size_t dropped_non_finite = 0;
  std::string sha256 = {};  ///< Of the bytes that the points come from; empty if there is no file.

  /// Appends the point if it is finite as float; else counts it as dropped.
  void add(const Eigen::Vector3d& point) {
    const Eigen::Vector3f rounded = point.cast<float>();
    if (rounded.allFinite()) {
      points.push_back(rounded);
    } else {
      ++dropped_non_finite;
    }
  }
};

/// The measurements of one scan (one revolution of the LiDAR): one element of each list per point,
/// in the order of firing.
struct MeasuredCloud {
  PointCloud points;             ///< In the sensor's frame at the time when the ray was fired.
  std::vector<float> intensity;  ///< 0 to 255.
  std::vector<std::uint16_t> ring;
  std::vector<double> time_s;  ///< When the ray was fired.
};

}  // namespace croon

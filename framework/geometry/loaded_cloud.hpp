#pragma once

#include <cstddef>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

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

}  // namespace croon

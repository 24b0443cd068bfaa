#pragma once

#include <cstdint>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// What a sensor delivers of one sweep: an element of each list per point, in the order of firing.
struct MeasuredCloud {
  PointCloud points;             ///< In the sensor's frame where it was when the ray was fired.
  std::vector<float> intensity;  ///< 0 to 255.
  std::vector<std::uint16_t> ring;
  std::vector<double> time_s;  ///< When the ray was fired.
};

}  // namespace croon

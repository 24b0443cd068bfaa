#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The number of measured points that each point of a cloud stands for: the value of its channel
/// kMeanOf, at most 1e9; 1 if the channel is missing or its value is below 1 or NaN.
inline std::vector<std::uint32_t> measured_points(const PointCloud& cloud) {
  constexpr double kMaxMeasuredPoints = 1e9;
  std::vector<std::uint32_t> counts(cloud.size(), 1);
  const Channel* const mean_of = find_channel(cloud, kMeanOf);
  if (mean_of == nullptr) return counts;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double count = mean_of->value(i);
    if (count >= 1.0) counts[i] = static_cast<std::uint32_t>(std::min(count, kMaxMeasuredPoints));
  }
  return counts;
}

}  // namespace croon

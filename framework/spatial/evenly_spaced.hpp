#pragma once

#include <algorithm>
#include <cstddef>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The position, among `size` elements, of element `i` out of `count` evenly spaced ones.
inline std::size_t evenly_spaced_index(std::size_t i, std::size_t size, std::size_t count) {
  return i * size / count;
}

/// At most `max_count` of `points`, evenly spaced and in their order.
inline Points evenly_spaced(const Points& points, int max_count) {
  const std::size_t size = points.size();
  const std::size_t count = std::min(size, static_cast<std::size_t>(max_count));
  Points sample;
  sample.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    sample.push_back(points[evenly_spaced_index(i, size, count)]);
  }
  return sample;
}

}  // namespace croon

#pragma once

#include <algorithm>
#include <cstddef>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// At most `most` of `points`, evenly through the list and in its order: all if there are no more.
inline Points evenly_spaced(const Points& points, int most) {
  const std::size_t size = points.size();
  const std::size_t count = std::min(size, static_cast<std::size_t>(most));
  Points sample;
  sample.reserve(count);
  for (std::size_t i = 0; i < count; ++i) sample.push_back(points[i * size / count]);
  return sample;
}

}  // namespace croon

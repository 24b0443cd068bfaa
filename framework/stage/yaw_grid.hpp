#pragma once

#include <cmath>
#include <vector>

namespace croon {

/// The multiples of `step_deg` within +-`range_deg`, nearest to zero first: 0, 1, -1, 2, -2, ...
/// Taken in this order with a strict comparison, the least of equal costs is the one that turns the
/// sensor least. Of -180 and 180 degrees, which are one yaw, only the second is there.
inline std::vector<int> yaw_grid(double range_deg, double step_deg) {
  // The addend lets a range that is a multiple of the step but for rounding reach its ends.
  const int count = static_cast<int>(std::floor(range_deg / step_deg + 1e-9));
  std::vector<int> grid = {0};
  for (int i = 1; i <= count; ++i) {
    grid.push_back(i);
    if (i * step_deg < 180.0 - 1e-9) grid.push_back(-i);
  }
  return grid;
}

}  // namespace croon

#include "framework/stage/yaw_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "framework/base/angles.hpp"

namespace croon {

std::vector<int> yaw_grid(double range_deg, double step_deg) {
  // The addend ensures that a range that is a multiple of the step includes its ends.
  const int count = static_cast<int>(std::floor(range_deg / step_deg + 1e-9));
  std::vector<int> grid = {0};
  for (int i = 1; i <= count; ++i) {
    grid.push_back(i);
    if (i * step_deg < 180.0 - 1e-9) grid.push_back(-i);
  }
  return grid;
}

GridMinimum min_on_grid(const YawCost& cost, double range_deg, double step_deg) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<int> grid = yaw_grid(range_deg, step_deg);
  const auto yaw_rad = [&](std::size_t i) { return rad_from_deg(grid[i] * step_deg); };
  std::vector<double> estimates;
  for (std::size_t i = 0; i < grid.size(); ++i)
    estimates.push_back(cost.cheap_estimate(yaw_rad(i)));
  std::vector<std::size_t> order(grid.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return estimates[a] < estimates[b]; });
  std::size_t best = order.front();
  double min_cost = cost(yaw_rad(best));
  for (std::size_t n = 1; n < order.size(); ++n) {
    const std::size_t i = order[n];
    const double upper_bound = i < best ? std::nextafter(min_cost, kInfinity) : min_cost;
    const double yaw_cost = cost.below(yaw_rad(i), upper_bound);
    if (yaw_cost >= upper_bound) continue;
    best = i;
    min_cost = yaw_cost;
  }
  return {grid[best], min_cost, static_cast<int>(grid.size())};
}

}  // namespace croon

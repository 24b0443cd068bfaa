#pragma once

#include <cmath>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include "framework/base/angles.hpp"

namespace croon {

/// Cost of a yaw angle, rad, relative to the start; never NaN.
class YawCost {
 public:
  using OfYaw = std::function<double(double yaw_rad)>;
  using OfYawBelow = std::function<double(double yaw_rad, double enough)>;

  /// From a function of yaw, and one that may stop early as `below` says.
  template <class Function,
            class = std::enable_if_t<std::is_invocable_r_v<double, const Function&, double>>>
  // A function is converted where one is expected.
  YawCost(Function of_yaw, OfYawBelow of_yaw_below = {})  // NOLINT(*-explicit-*)
      : of_yaw_(std::move(of_yaw)), of_yaw_below_(std::move(of_yaw_below)) {}

  double operator()(double yaw_rad) const { return of_yaw_(yaw_rad); }

  /// The cost if it is below `enough`, else any number that is not. It saves most of a sum if a
  /// search asks only whether a yaw costs less than another.
  double below(double yaw_rad, double enough) const {
    return of_yaw_below_ ? of_yaw_below_(yaw_rad, enough) : of_yaw_(yaw_rad);
  }

 private:
  OfYaw of_yaw_;
  OfYawBelow of_yaw_below_;
};

/// The yaw of least cost that a search found.
struct YawMinimum {
  double yaw_rad = 0.0;
  double cost = 0.0;
  int evaluations = 0;
};

/// Minimises a function of yaw (paper, rough calibration). It never sees clouds.
class YawSearch {
 public:
  using Kind = YawSearch;
  static constexpr const char* kKind = "yaw_search";
  static constexpr const char* kKindSummary = "Minimises a function of yaw.";
  static constexpr int kKindOrder = 40;
  virtual ~YawSearch() = default;

  /// The yaw of least cost near zero.
  virtual YawMinimum minimise(const YawCost& cost) const = 0;
};

/// The multiples of `step_deg` within +-`range_deg`, nearest to zero first: 0, 1, -1, 2, -2, ...
/// With this order and a strict comparison, the smallest turn wins among equal costs. Of -180 and
/// 180 degrees, which are the same yaw, the list has only 180.
inline std::vector<int> yaw_grid(double range_deg, double step_deg) {
  // The addend makes a range that is a multiple of the step, up to rounding, include its ends.
  const int count = static_cast<int>(std::floor(range_deg / step_deg + 1e-9));
  std::vector<int> grid = {0};
  for (int i = 1; i <= count; ++i) {
    grid.push_back(i);
    if (i * step_deg < 180.0 - 1e-9) grid.push_back(-i);
  }
  return grid;
}

/// The least of `cost` on the grid of `yaw_grid`, of equal costs the first.
inline YawMinimum least_on_grid(const YawCost& cost, double range_deg, double step_deg) {
  YawMinimum least{0.0, cost(0.0), 1};
  const std::vector<int> grid = yaw_grid(range_deg, step_deg);
  for (std::size_t i = 1; i < grid.size(); ++i) {
    const double yaw_rad = rad_from_deg(grid[i] * step_deg);
    const double yaw_cost = cost.below(yaw_rad, least.cost);
    if (yaw_cost < least.cost) least = {yaw_rad, yaw_cost, 0};
  }
  least.evaluations = static_cast<int>(grid.size());
  return least;
}

}  // namespace croon

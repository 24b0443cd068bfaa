#pragma once

#include <functional>

namespace croon {

/// Cost of a yaw angle, rad, relative to the start.
using YawCost = std::function<double(double)>;

/// Where a search found the least cost.
struct YawMinimum {
  double yaw_rad = 0.0;
  double cost = 0.0;
  int evaluations = 0;
};

/// Finds the least of a function of yaw (paper, rough calibration). Sees a function, never clouds.
class YawSearch {
 public:
  using Kind = YawSearch;
  static constexpr const char* kKind = "yaw_search";
  static constexpr const char* kKindSummary = "Finds the least of a function of yaw.";
  static constexpr int kKindOrder = 40;
  virtual ~YawSearch() = default;

  /// The yaw of least cost near zero. The costs of the yaws that it looks at must not be NaN.
  virtual YawMinimum minimise(const YawCost& cost) const = 0;
};

}  // namespace croon

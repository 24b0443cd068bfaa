#pragma once

#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

namespace croon {

/// Cost function of a yaw angle, rad, relative to the start; never NaN.
class YawCost {
 public:
  using OfYaw = std::function<double(double yaw_rad)>;
  using OfYawBelow = std::function<double(double yaw_rad, double upper_bound)>;

  /// From a function of yaw, one that may stop early as in `below`, and one for `cheap_estimate`.
  template <class Function,
            class = std::enable_if_t<std::is_invocable_r_v<double, const Function&, double>>>
  // Implicit on purpose: callables convert.
  YawCost(Function of_yaw, OfYawBelow of_yaw_below = {},
          OfYaw cheap_estimate = {})  // NOLINT(*-explicit-*)
      : of_yaw_(std::move(of_yaw)),
        of_yaw_below_(std::move(of_yaw_below)),
        cheap_estimate_(std::move(cheap_estimate)) {}

  double operator()(double yaw_rad) const { return of_yaw_(yaw_rad); }

  /// The cost if it is below `upper_bound`, otherwise any number that is not below it. Saves most
  /// of a sum if a search only needs to know whether one yaw costs less than another.
  double below(double yaw_rad, double upper_bound) const {
    return of_yaw_below_ ? of_yaw_below_(yaw_rad, upper_bound) : of_yaw_(yaw_rad);
  }

  /// A cheap estimate of the cost, or the same number for every yaw. Tells a search where to look
  /// first.
  double cheap_estimate(double yaw_rad) const {
    return cheap_estimate_ ? cheap_estimate_(yaw_rad) : 0.0;
  }

 private:
  OfYaw of_yaw_;
  OfYawBelow of_yaw_below_;
  OfYaw cheap_estimate_;
};

/// The yaw of minimum cost that a search found.
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

  /// The yaw of minimum cost near zero.
  virtual YawMinimum minimise(const YawCost& cost) const = 0;
};

/// The multiples of `step_deg` within +-`range_deg`, nearest to zero first: 0, 1, -1, 2, -2, ...
/// Contains 180 but not -180 degrees, which is the same yaw.
std::vector<int> yaw_grid(double range_deg, double step_deg);

/// The minimum cost on a grid.
struct GridMinimum {
  int multiple = 0;  ///< Of the step.
  double cost = 0.0;
  int evaluations = 0;
};

/// The minimum of `cost` on the grid of `yaw_grid`; in case of ties the first, i.e. the smallest
/// rotation. Starts with the yaws of low estimated cost, so that most others can be ruled out
/// early.
GridMinimum min_on_grid(const YawCost& cost, double range_deg, double step_deg);

}  // namespace croon

#include <algorithm>

#include "framework/base/angles.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::stages::yaw_search {
namespace {

struct Params {
  double range_deg = 90.0;
  double bracket_step_deg = 5.0;
  double tolerance_deg = 0.05;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows = {
        params::number("range_deg", &Params::range_deg, {0.01, 180.0},
                       "Half range of the search around the start."),
        params::number(
            "bracket_step_deg", &Params::bracket_step_deg, {0.001, 180.0},
            "Step of the grid whose best yaw and its two neighbours bracket the minimum."),
        params::number("tolerance_deg", &Params::tolerance_deg, {1e-6, 180.0},
                       "The search ends when the bracket is no wider than this."),
    };
    return rows.require([](const Params& p) { return p.bracket_step_deg <= p.range_deg; },
                        "bracket_step_deg must not be greater than range_deg");
  }();
  return table;
}

/// The share of a segment that is cut off: `1 - 1 / golden ratio`.
constexpr double kGoldenShare = 0.38196601125010515;

/// Golden section search (Kiefer 1953): of a bracket `low < best < high` whose middle costs least,
/// the longer side is cut, and the cheaper of the cut and the middle is the next bracket's middle.
class GoldenSection final : public YawSearch {
 public:
  explicit GoldenSection(const Params& params) : params_(params) {}

  YawMinimum minimise(const YawCost& cost) const override {
    const GridMinimum on_grid = min_on_grid(cost, params_.range_deg, params_.bracket_step_deg);
    YawMinimum least = {rad_from_deg(on_grid.multiple * params_.bracket_step_deg), on_grid.cost,
                        on_grid.evaluations};
    const double tolerance_rad = rad_from_deg(params_.tolerance_deg);
    const double step_rad = rad_from_deg(params_.bracket_step_deg);
    // All around there is no end; else the bracket stays inside of the range.
    const double range_rad = rad_from_deg(params_.range_deg < 180.0 ? params_.range_deg : 360.0);
    double low_rad = std::max(least.yaw_rad - step_rad, -range_rad);
    double high_rad = std::min(least.yaw_rad + step_rad, range_rad);
    while (high_rad - low_rad > tolerance_rad) {
      const bool goes_up = high_rad - least.yaw_rad > least.yaw_rad - low_rad;
      double& far_rad = goes_up ? high_rad : low_rad;
      double& near_rad = goes_up ? low_rad : high_rad;
      const double cut_rad = least.yaw_rad + kGoldenShare * (far_rad - least.yaw_rad);
      const double cut_cost = cost.below(cut_rad, least.cost);
      ++least.evaluations;
      if (cut_cost < least.cost) {
        near_rad = least.yaw_rad;
        least.yaw_rad = cut_rad;
        least.cost = cut_cost;
      } else {
        far_rad = cut_rad;
      }
    }
    return least;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry golden_section() {
  return stage_entry<GoldenSection>(
      "golden_section",
      "Brackets the minimum on a coarse grid, then narrows the bracket by the golden ratio.",
      "Kiefer, Sequential minimax search for a maximum, 1953", table(), 2);
}

}  // namespace croon::stages::yaw_search

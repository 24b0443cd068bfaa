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
                       "Half range of the search around the initial yaw."),
        params::number(
            "bracket_step_deg", &Params::bracket_step_deg, {0.001, 180.0},
            "Step of the grid whose best yaw and its two neighbours bracket the minimum."),
        params::number("tolerance_deg", &Params::tolerance_deg, {1e-6, 180.0},
                       "Bracket width at which the search ends."),
    };
    return rows.require([](const Params& p) { return p.bracket_step_deg <= p.range_deg; },
                        "bracket_step_deg must not be greater than range_deg");
  }();
  return table;
}

/// Fraction of a segment that is cut off: `2 - golden ratio`.
constexpr double kGoldenShare = 0.38196601125010515;

/// Golden section search (Kiefer 1953): evaluates a cut in the longer side of a bracket `low < best
/// < high`, whose middle has the minimum cost; the cheaper of the cut and the middle becomes the
/// middle of the next bracket.
class GoldenSection final : public YawSearch {
 public:
  explicit GoldenSection(const Params& params) : params_(params) {}

  YawMinimum minimise(const YawCost& cost) const override {
    const GridMinimum on_grid = min_on_grid(cost, params_.range_deg, params_.bracket_step_deg);
    YawMinimum best = {rad_from_deg(on_grid.multiple * params_.bracket_step_deg), on_grid.cost,
                       on_grid.evaluations};
    const double tolerance_rad = rad_from_deg(params_.tolerance_deg);
    const double step_rad = rad_from_deg(params_.bracket_step_deg);
    // A full circle has no ends; otherwise the bracket stays within the range.
    const double range_rad = rad_from_deg(params_.range_deg < 180.0 ? params_.range_deg : 360.0);
    double low_rad = std::max(best.yaw_rad - step_rad, -range_rad);
    double high_rad = std::min(best.yaw_rad + step_rad, range_rad);
    while (high_rad - low_rad > tolerance_rad) {
      const bool goes_up = high_rad - best.yaw_rad > best.yaw_rad - low_rad;
      double& far_rad = goes_up ? high_rad : low_rad;
      double& near_rad = goes_up ? low_rad : high_rad;
      const double cut_rad = best.yaw_rad + kGoldenShare * (far_rad - best.yaw_rad);
      const double cut_cost = cost.below(cut_rad, best.cost);
      ++best.evaluations;
      if (cut_cost < best.cost) {
        near_rad = best.yaw_rad;
        best.yaw_rad = cut_rad;
        best.cost = cut_cost;
      } else {
        far_rad = cut_rad;
      }
    }
    return best;
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

#include <cmath>
#include <cstdint>
#include <set>

#include "framework/base/angles.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::stages::yaw_search {
namespace {

struct Params {
  double range_deg = 90.0;
  double step_deg = 5.0;
  int levels = 6;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = [] {
    params::Table<Params> rows = {
        params::number(
            "range_deg", &Params::range_deg, {0.01, 180.0},
            "Half range of the first level around the initial yaw; 50 in the authors' code."),
        params::number("step_deg", &Params::step_deg, {0.001, 180.0},
                       "Step of the first level's grid; 5 in the authors' code."),
        params::integer("levels", &Params::levels, {1, 20},
                        "Number of grids, each with half the range and half the step of the "
                        "previous one; 5 in the authors' code."),
    };
    return rows.require([](const Params& p) { return p.step_deg <= p.range_deg; },
                        "step_deg must not be greater than range_deg");
  }();
  return table;
}

/// The halving scan that the paper calls binary search (rough calibration), as in the authors'
/// code: a grid around the initial yaw, then repeatedly a grid of half the range and half the step
/// around the best yaw so far.
class Binary final : public YawSearch {
 public:
  explicit Binary(const Params& params) : params_(params) {}

  YawMinimum minimise(const YawCost& cost) const override {
    const double finest_step_deg = std::ldexp(params_.step_deg, 1 - params_.levels);
    // Yaws are integer multiples of the last level's step, so every second yaw of a level was
    // evaluated in the previous level and cannot be better now.
    const std::int64_t first_step = std::int64_t{1} << (params_.levels - 1);
    std::set<std::int64_t> evaluated;
    for (const int i : yaw_grid(params_.range_deg, params_.step_deg)) {
      evaluated.insert(i * first_step);
    }
    const GridMinimum on_first = min_on_grid(cost, params_.range_deg, params_.step_deg);
    std::int64_t best = on_first.multiple * first_step;
    double min_cost = on_first.cost;
    for (int level = 1; level < params_.levels; ++level) {
      const std::int64_t centre = best;
      const std::int64_t step = std::int64_t{1} << (params_.levels - 1 - level);
      const double scale = std::ldexp(1.0, -level);
      for (const int i : yaw_grid(params_.range_deg * scale, params_.step_deg * scale)) {
        const std::int64_t yaw = centre + i * step;
        if (!evaluated.insert(yaw).second) continue;
        const double yaw_cost =
            cost.below(rad_from_deg(static_cast<double>(yaw) * finest_step_deg), min_cost);
        if (yaw_cost < min_cost) {
          min_cost = yaw_cost;
          best = yaw;
        }
      }
    }
    return {rad_from_deg(static_cast<double>(best) * finest_step_deg), min_cost,
            static_cast<int>(evaluated.size())};
  }

 private:
  Params params_;
};

}  // namespace

StageEntry binary() {
  return stage_entry<Binary>(
      "binary",
      "Evaluates a grid of yaws, then successively finer and narrower grids around the best yaw.",
      "CROON (arXiv 2203.03182), rough calibration; scheme of its public code (lidar2lidar, commit "
      "c0e1e2b), with our default range and levels",
      table());
}

}  // namespace croon::stages::yaw_search

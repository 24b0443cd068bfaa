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
        params::number("range_deg", &Params::range_deg, {0.01, 180.0},
                       "Half range of the first level around the start; the authors' 50."),
        params::number("step_deg", &Params::step_deg, {0.001, 180.0},
                       "Step of the first level's grid; the authors' 5."),
        params::integer(
            "levels", &Params::levels, {1, 20},
            "The number of grids, each of half the range and half the step of the one before; the "
            "authors' 5."),
    };
    return rows.require([](const Params& p) { return p.step_deg <= p.range_deg; },
                        "step_deg must not be greater than range_deg");
  }();
  return table;
}

/// The halving scan that the paper calls binary search (rough calibration) as the authors' code has
/// it: a grid around the start, then around the best yaw so far one of half the range and half the
/// step, and so on.
class Binary final : public YawSearch {
 public:
  explicit Binary(const Params& params) : params_(params) {}

  YawMinimum minimise(const YawCost& cost) const override {
    const double finest_step_deg = std::ldexp(params_.step_deg, 1 - params_.levels);
    // Yaws are integer multiples of the last level's step, so every second yaw of a level was
    // evaluated in the level before. It was not less then and is not now.
    const std::int64_t first_step = std::int64_t{1} << (params_.levels - 1);
    std::set<std::int64_t> evaluated;
    for (const int i : yaw_grid(params_.range_deg, params_.step_deg)) {
      evaluated.insert(i * first_step);
    }
    const GridMinimum on_first = min_on_grid(cost, params_.range_deg, params_.step_deg);
    std::int64_t best = on_first.multiple * first_step;
    double least = on_first.cost;
    for (int level = 1; level < params_.levels; ++level) {
      const std::int64_t centre = best;
      const std::int64_t step = std::int64_t{1} << (params_.levels - 1 - level);
      const double scale = std::ldexp(1.0, -level);
      for (const int i : yaw_grid(params_.range_deg * scale, params_.step_deg * scale)) {
        const std::int64_t yaw = centre + i * step;
        if (!evaluated.insert(yaw).second) continue;
        const double yaw_cost =
            cost.below(rad_from_deg(static_cast<double>(yaw) * finest_step_deg), least);
        if (yaw_cost < least) {
          least = yaw_cost;
          best = yaw;
        }
      }
    }
    return {rad_from_deg(static_cast<double>(best) * finest_step_deg), least,
            static_cast<int>(evaluated.size())};
  }

 private:
  Params params_;
};

}  // namespace

StageEntry binary() {
  return stage_entry<Binary>(
      "binary", "Evaluates a grid of yaws, then ever finer and narrower grids around the best yaw.",
      "CROON (arXiv 2203.03182), rough calibration; the scheme is that of its public code "
      "(lidar2lidar, commit c0e1e2b), the default range and levels are ours",
      table());
}

}  // namespace croon::stages::yaw_search

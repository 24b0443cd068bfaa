#include "framework/base/angles.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/yaw_grid.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::stages::yaw_search {
namespace {

struct Params {
  double range_deg = 90.0;
  double step_deg = 1.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("range_deg", &Params::range_deg, {0.01, 180.0},
                     "How far the search looks to each side of the start."),
      params::number("step_deg", &Params::step_deg, {0.001, 180.0}, "Step of the grid."),
  };
  return table;
}

class Exhaustive final : public YawSearch {
 public:
  explicit Exhaustive(const Params& params) : params_(params) {}

  YawMinimum minimise(const YawCost& cost) const override {
    YawMinimum least{0.0, cost(0.0), 0};
    const std::vector<int> grid = yaw_grid(params_.range_deg, params_.step_deg);
    for (std::size_t i = 1; i < grid.size(); ++i) {
      const double yaw_rad = rad_from_deg(grid[i] * params_.step_deg);
      const double yaw_cost = cost(yaw_rad);
      if (yaw_cost < least.cost) least = {yaw_rad, yaw_cost, 0};
    }
    least.evaluations = static_cast<int>(grid.size());
    return least;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry exhaustive() {
  return stage_entry<Exhaustive>(
      "exhaustive", "Looks at every yaw of a grid around the start; the measure of the others.",
      "croon", table());
}

}  // namespace croon::stages::yaw_search

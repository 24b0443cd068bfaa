#include "framework/base/angles.hpp"
#include "framework/stage/stage_entry.hpp"
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
                     "Half range of the search around the initial yaw."),
      params::number("step_deg", &Params::step_deg, {0.001, 180.0}, "Step of the grid."),
  };
  return table;
}

class Exhaustive final : public YawSearch {
 public:
  explicit Exhaustive(const Params& params) : params_(params) {}

  YawMinimum minimise(const YawCost& cost) const override {
    const GridMinimum minimum = min_on_grid(cost, params_.range_deg, params_.step_deg);
    return {rad_from_deg(minimum.multiple * params_.step_deg), minimum.cost, minimum.evaluations};
  }

 private:
  Params params_;
};

}  // namespace

StageEntry exhaustive() {
  return stage_entry<Exhaustive>(
      "exhaustive",
      "Evaluates every yaw of a grid around the initial one; the baseline for the other searches.",
      "croon", table());
}

}  // namespace croon::stages::yaw_search

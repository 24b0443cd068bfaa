#include "framework/pipeline/step_options.hpp"
#include "framework/spatial/turning_cost.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "framework/stage/yaw_search.hpp"

namespace croon::stages::step {
namespace {

struct Params : NearestCostOptions {
  params::Slot<YawSearch> search;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::slot("search", &Params::search, R"({"type": "binary"})",
                       "Finds the yaw of minimum cost."),
      }
          .inherit(nearest_cost_table());
  return table;
}

class YawAlignment final : public Step {
 public:
  explicit YawAlignment(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    TurningCost cost(nearest_cost(estimate, params_), estimate.T_target_source, estimate.up());
    const YawMinimum minimum = params_.search->minimise(
        {[&](double yaw_rad) { return cost(yaw_rad); },
         [&](double yaw_rad, double upper_bound) { return cost.below(yaw_rad, upper_bound); },
         [&](double yaw_rad) { return cost.cheap_estimate(yaw_rad); }});
    estimate.set_pose(cost.turned(minimum.yaw_rad));
    estimate.diagnostics = {{"cost_m2", minimum.cost},
                            {"evaluations", static_cast<double>(minimum.evaluations)}};
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry yaw_alignment() {
  return stage_entry<YawAlignment>(
      "yaw_alignment",
      "Rotates the sensor about the ground normal to minimise the nearest-neighbour distance: yaw.",
      "CROON (arXiv 2203.03182), rough calibration", table());
}

}  // namespace croon::stages::step

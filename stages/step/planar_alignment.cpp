#include "framework/pipeline/step_options.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params : NearestCostOptions {
  params::Slot<PoseSearch> search;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::slot(
              "search", &Params::search,
              R"({"type": "coordinate_scan", "dofs": ["x", "y"], "translation_step_m": 0.1, )"
              R"("min_decrease_ratio": 0.0001})",
              "Finds the pose of minimum cost; the paper searches x, then y."),
      }
          .inherit(nearest_cost_table());
  return table;
}

class PlanarAlignment final : public Step {
 public:
  explicit PlanarAlignment(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    const NearestDistanceCost cost = nearest_cost(estimate, params_);
    const PoseMinimum minimum = params_.search->minimise(cost, estimate.T_target_source);
    estimate.set_pose(minimum.pose);
    estimate.diagnostics = {{"cost_m2", minimum.cost},
                            {"evaluations", static_cast<double>(minimum.evaluations)}};
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry planar_alignment() {
  return stage_entry<PlanarAlignment>(
      "planar_alignment",
      "Moves the sensor along the reference's x and y to minimise the nearest-neighbour distance.",
      "CROON (arXiv 2203.03182), rough calibration", table());
}

}  // namespace croon::stages::step

#include "framework/pipeline/point_selection.hpp"
#include "framework/spatial/nearest_distance_cost.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<PoseSearch> search;
  std::string points = "non_ground";
  int max_points = 1500;
  double max_distance_m = 2.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("search", &Params::search,
                   R"({"type": "coordinate_scan", "dofs": ["x", "y"], "translation_step_m": 0.1})",
                   "Finds the pose of least cost; the paper searches x, then y."),
      params::choice("points", &Params::points, kPointChoices,
                     "Which points the cost looks at; ground says nothing of x and y."),
      params::integer("max_points", &Params::max_points, {10, 1e9},
                      "At most so many points of the sensor are looked at, evenly spaced."),
      params::number("max_distance_m", &Params::max_distance_m, {0.01, 1e6},
                     "A nearest-neighbour distance counts for at most this."),
  };
  return table;
}

class PlanarAlignment final : public Step {
 public:
  explicit PlanarAlignment(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    const SelectedClouds clouds = selected_clouds(estimate, params_.points);
    const NearestDistanceCost cost(clouds.target, *clouds.source, params_.max_points,
                                   params_.max_distance_m);
    const PoseMinimum minimum = params_.search->minimise(cost, estimate.T_target_source);
    estimate.T_target_source = minimum.pose;
    estimate.figures = {{"cost_m2", minimum.cost},
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
      "Moves the sensor over the ground to the least nearest-neighbour distance: x, y.",
      "CROON (arXiv 2203.03182), rough calibration", table());
}

}  // namespace croon::stages::step

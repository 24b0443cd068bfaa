#include "framework/pipeline/step_options.hpp"

#include "framework/base/error.hpp"

namespace croon {

SelectedClouds selected_clouds(const Estimate& estimate, PointSelection points) {
  SelectedClouds clouds{estimate.target, estimate.source};
  if (points == PointSelection::non_ground && estimate.target_ground && estimate.source_ground) {
    clouds = {estimate.target_ground->non_ground, estimate.source_ground->non_ground};
  }
  const std::string left = " has no points left (" + params::word_of(kPointsWords, points) + ")";
  if (clouds.target->empty()) throw StageError("the reference" + left);
  if (clouds.source->empty()) throw StageError("the sensor" + left);
  return clouds;
}

const params::Table<NearestCostOptions>& nearest_cost_table() {
  static const params::Table<NearestCostOptions> table = {
      params::choice("points", &NearestCostOptions::points, kPointsWords,
                     "Points that the cost uses; the ground does not constrain yaw, x and y."),
      params::integer("max_points", &NearestCostOptions::max_points, {10, 1e9},
                      "Maximum number of the sensor's points, evenly spaced."),
      params::number("max_distance_m", &NearestCostOptions::max_distance_m, {0.01, 1e6},
                     "Maximum nearest-neighbour distance; larger ones are truncated."),
  };
  return table;
}

NearestDistanceCost nearest_cost(const Estimate& estimate, const NearestCostOptions& options) {
  const SelectedClouds clouds = selected_clouds(estimate, options.points);
  return NearestDistanceCost(clouds.target, *clouds.source, options.max_points,
                             options.max_distance_m);
}

}  // namespace croon

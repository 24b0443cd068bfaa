#include "framework/pipeline/nearest_cost_options.hpp"

namespace croon {

const params::Table<NearestCostOptions>& nearest_cost_table() {
  static const params::Table<NearestCostOptions> table = {
      params::choice("points", &NearestCostOptions::points, kPointsWords,
                     "Which points the cost looks at; ground says nothing of yaw, x and y."),
      params::integer("max_points", &NearestCostOptions::max_points, {10, 1e9},
                      "At most so many points of the sensor are looked at, evenly spaced."),
      params::number("max_distance_m", &NearestCostOptions::max_distance_m, {0.01, 1e6},
                     "A nearest-neighbour distance counts for at most this."),
  };
  return table;
}

NearestDistanceCost nearest_cost(const Estimate& estimate, const NearestCostOptions& options) {
  const SelectedClouds clouds = selected_clouds(estimate, options.points);
  return NearestDistanceCost(clouds.target, *clouds.source, options.max_points,
                             options.max_distance_m);
}

}  // namespace croon

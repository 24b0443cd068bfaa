#pragma once

#include "framework/params/table.hpp"
#include "framework/pipeline/point_selection.hpp"
#include "framework/spatial/nearest_distance_cost.hpp"
#include "framework/stage/step.hpp"

namespace croon {

/// The parameters of the steps that make the nearest-neighbour distances least. A step's own
/// parameters derive from this and its table inherits nearest_cost_table().
struct NearestCostOptions {
  Points points = Points::non_ground;
  int max_points = 1500;
  double max_distance_m = 2.0;
};

/// The rows of NearestCostOptions.
const params::Table<NearestCostOptions>& nearest_cost_table();

/// The cost between the selected clouds of `estimate`. Throws StageError where one of them is
/// empty.
NearestDistanceCost nearest_cost(const Estimate& estimate, const NearestCostOptions& options);

}  // namespace croon

#pragma once

#include <memory>

#include "framework/params/choice.hpp"
#include "framework/params/table.hpp"
#include "framework/spatial/nearest_distance_cost.hpp"
#include "framework/stage/step.hpp"

namespace croon {

/// The points of the two clouds that a step uses.
enum class PointSelection { non_ground, all };

/// The choices of a step's parameter `points`.
inline const params::Words<PointSelection> kPointsWords = {
    {"non_ground", PointSelection::non_ground}, {"all", PointSelection::all}};

/// The target and source clouds that a step uses.
struct SelectedClouds {
  std::shared_ptr<const Cloud> target;
  std::shared_ptr<const Cloud> source;
};

/// The clouds with the selected points. PointSelection::non_ground selects all points if no earlier
/// step has found the ground. Throws StageError if a selected cloud is empty.
SelectedClouds selected_clouds(const Estimate& estimate, PointSelection points);

/// The parameters of the steps that minimise the nearest-neighbour distances. A step's own
/// parameters derive from this and its table inherits nearest_cost_table().
struct NearestCostOptions {
  PointSelection points = PointSelection::non_ground;
  int max_points = 1500;
  double max_distance_m = 2.0;
};

/// The rows of NearestCostOptions.
const params::Table<NearestCostOptions>& nearest_cost_table();

/// The cost between the selected clouds of `estimate`. Throws StageError if one of them is
/// empty.
NearestDistanceCost nearest_cost(const Estimate& estimate, const NearestCostOptions& options);

}  // namespace croon

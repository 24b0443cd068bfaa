#pragma once

#include <string>
#include <vector>

#include "framework/params/node.hpp"

namespace croon::experiments {

/// One value of an axis of a grid.
struct GridPoint {
  std::string label;  ///< Different for each point of the axis.
  params::Node value;
};

/// A part of the pipeline and the values that the grid gives it, one after the other.
struct GridAxis {
  std::string path;
  params::Node node;  ///< The list in the file.
  std::vector<GridPoint> points;
};

/// The axes of the object `grid`, by path. A stage is labelled by its type ("pointer_octree"), with
/// the parameters in which it differs from others of that type ("pointer_octree(leaf_size_m=0.1)");
/// any other value by its key ("leaf_size_m=0.1"). Notes faults in the node.
std::vector<GridAxis> read_grid(const params::Node& grid);

}  // namespace croon::experiments

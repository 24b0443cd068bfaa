#pragma once

#include <string>
#include <vector>

#include "framework/params/node.hpp"

namespace croon::experiments {

/// One value that a grid puts in a place of the pipeline.
struct GridPoint {
  std::string label;  ///< Different for each point of the axis.
  params::Node value;
};

/// A place of the pipeline and the values that the grid puts there, one after the other.
struct GridAxis {
  std::string path;
  params::Node node;  ///< The list in the file.
  std::vector<GridPoint> points;
};

/// The axes of the object `grid`, by path. A stage is labelled by its type ("pointer_octree"), with
/// the parameters that tell it from others of that type ("pointer_octree(leaf_size_m=0.1)"); any
/// other value by its key ("leaf_size_m=0.1"). Notes faults in the node.
std::vector<GridAxis> read_grid(const params::Node& grid);

}  // namespace croon::experiments

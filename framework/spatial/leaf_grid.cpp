#include "framework/spatial/leaf_grid.hpp"

#include <sstream>

#include "framework/base/error.hpp"

namespace croon {

void LeafGrid::refuse(const Eigen::Vector3d& point) const {
  std::ostringstream message;
  message << "a point at (" << point.x() << ", " << point.y() << ", " << point.z()
          << ") m is outside of the grid of leaves: with a leaf size of " << leaf_size_m_
          << " m a coordinate reaches to " << kMaxIndex * leaf_size_m_ << " m";
  throw StageError(message.str());
}

}  // namespace croon

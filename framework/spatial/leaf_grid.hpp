#pragma once

#include <Eigen/Core>
#include <cmath>

namespace croon {

/// The grid of cubes that every volume scorer and the voxel filter share: leaf (i, j, k) holds the points p
/// with `i = floor(x / leaf_size)` and so on, in the frame of the points. One function decides for all of
/// them, so their counts are equal to the last leaf.
class LeafGrid {
 public:
  explicit LeafGrid(double leaf_size_m) : leaf_size_m_(leaf_size_m), inverse_(1.0 / leaf_size_m) {}

  Eigen::Vector3i leaf_of(const Eigen::Vector3d& point) const {
    return {static_cast<int>(std::floor(point.x() * inverse_)),
            static_cast<int>(std::floor(point.y() * inverse_)),
            static_cast<int>(std::floor(point.z() * inverse_))};
  }
  double leaf_size_m() const { return leaf_size_m_; }

 private:
  double leaf_size_m_;
  double inverse_;
};

}  // namespace croon

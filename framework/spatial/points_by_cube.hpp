#pragma once

#include <algorithm>
#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {

/// Points sorted by cubes of space, for sums over all points within a distance, in an order that
/// depends only on the points.
class PointsByCube {
 public:
  /// Throws StageError for a point outside the grid (see LeafGrid).
  PointsByCube(const Points& points, double reach_m) : cubes_(reach_m) {
    for (const Eigen::Vector3f& point : points) {
      points_.push_back({cube_of(point.cast<double>()), point.cast<double>()});
    }
    std::stable_sort(points_.begin(), points_.end(),
                     [](const Entry& a, const Entry& b) { return a.cube < b.cube; });
  }

  std::size_t size() const { return points_.size(); }
  double reach_m() const { return cubes_.leaf_size_m(); }

  /// Calls `use(point, squared_distance_m2)` for all points within the reach of `place`.
  template <class Use>
  void for_each_near(const Eigen::Vector3d& place, const Use& use) const {
    const double reach_m2 = reach_m() * reach_m();
    const LeafKey middle = cube_of(place);
    for (int i = middle[0] - 1; i <= middle[0] + 1; ++i) {
      for (int j = middle[1] - 1; j <= middle[1] + 1; ++j) {
        // The cubes of a column are consecutive.
        const LeafKey last = {i, j, middle[2] + 1};
        auto entry =
            std::lower_bound(points_.begin(), points_.end(), LeafKey{i, j, middle[2] - 1},
                             [](const Entry& a, const LeafKey& cube) { return a.cube < cube; });
        for (; entry != points_.end() && entry->cube <= last; ++entry) {
          const double squared_m2 = (entry->point - place).squaredNorm();
          if (squared_m2 <= reach_m2) use(entry->point, squared_m2);
        }
      }
    }
  }

 private:
  struct Entry {
    LeafKey cube;
    Eigen::Vector3d point;
  };

  LeafKey cube_of(const Eigen::Vector3d& point) const { return leaf_key(cubes_.leaf_of(point)); }

  LeafGrid cubes_;
  std::vector<Entry> points_;
};

}  // namespace croon

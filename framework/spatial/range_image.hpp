#pragma once

#include <optional>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The returns of a sensor by direction: the nearest and the farthest of each cell of the six faces
/// of a cube around the sensor. A point in front of the nearest return contradicts the
/// measurement, because the sensor's ray passed through it.
class RangeImage {
 public:
  /// Ranges of returns in and around one cell, m.
  struct Seen {
    float nearest_m = 0.0F;
    float farthest_m = 0.0F;
  };

  /// `cells` is the number along each edge of a face: 90 are about one degree each. `points` in the
  /// sensor's frame.
  RangeImage(const Points& points, int cells);

  /// The returns in the direction of `point` (in the sensor's frame): those of the cell and of its
  /// neighbours on the same face. std::nullopt if the cell itself has no return.
  std::optional<Seen> at(const Eigen::Vector3d& point) const;

 private:
  struct Cell {
    int face = 0;
    int row = 0;
    int column = 0;
  };
  Cell cell_of(const Eigen::Vector3d& point) const;
  std::size_t index_of(const Cell& cell) const;

  int cells_;
  std::vector<Seen> returns_;  ///< By cell index; farthest_m is 0 without a return.
};

}  // namespace croon

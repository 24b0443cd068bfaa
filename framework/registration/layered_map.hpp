#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/params/table.hpp"

namespace croon {

/// The parameters of the comparison of clouds from above.
struct LayeredMapOptions {
  double cell_m = 0.5;                  ///< Edge of a cell, along x, y and the height.
  double min_height_m = 0.4;            ///< Lower points belong to the ground and are ignored.
  int layers = 8;                       ///< Layers of cells above min_height_m.
  double max_range_m = 40.0;            ///< Points of the source farther from it are ignored.
  double max_sensor_distance_m = 10.0;  ///< Maximum shift along x and along y.
  double yaw_step_deg = 2.0;
  int max_cells = 800;  ///< Maximum number of the source's cells that are used.
};

/// The rows of LayeredMapOptions.
const params::Table<LayeredMapOptions>& layered_map_table();

/// A pose of the source above the target's ground, both levelled, at which their cells coincide.
struct MapPeak {
  double yaw_rad = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double score = 0.0;  ///< In [0, 1]: 1 if all cells of the source lie on cells of the target.
};

/// The cells above the ground that a levelled cloud occupies (z up, ground at 0), dilated to their
/// neighbours for tolerance to shifts of half a cell.
class LayeredMap {
 public:
  LayeredMap(const Points& levelled, const LayeredMapOptions& options);

  /// The `count` best poses of `levelled_source`, no two within 2 cells and 3 steps of yaw, best
  /// first: correlative matching (Olson 2009) over all yaws and shifts, in whole numbers.
  std::vector<MapPeak> match(const Points& levelled_source, int count) const;

 private:
  using Sums = std::vector<std::uint16_t>;
  void spread(int layer, int row, int column, std::uint8_t value);
  /// The shifts (row, column) whose sums are not below those of their four neighbours.
  std::vector<std::pair<int, int>> local_maxima(const Sums& sums) const;
  void add_window(Sums& sums, int layer, int row, int column) const;

  LayeredMapOptions options_;
  int reach_;   ///< Cells.
  int side_;    ///< Cells along x and y; the origin is in the middle.
  int window_;  ///< Shifts along one axis, 2 reach + 1.
  int stride_;  ///< The window, rounded up to whole vectors.
  std::vector<std::uint8_t> cells_;
};

}  // namespace croon

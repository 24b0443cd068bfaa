#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
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
  int max_cells = 800;      ///< Maximum number of the source's cells that are used.
  double free_space = 0.0;  ///< Cost of a source's cell in free space; 1 for one that coincides.
};

/// The rows of LayeredMapOptions.
const params::Table<LayeredMapOptions>& layered_map_table();

/// A pose of the source above the target's ground, both levelled, at which their cells coincide.
struct MapPeak {
  double yaw_rad = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double score = 0.0;  ///< At most 1: all cells of the source lie on cells of the target.
};

/// The cells above the ground that a levelled cloud occupies (z up, ground at 0), dilated to their
/// neighbours for tolerance to shifts of half a cell, and with `free_space` those that it shows to
/// be free.
class LayeredMap {
 public:
  /// The sensor is above the origin at `height_m`.
  LayeredMap(const Points& levelled, double height_m, const LayeredMapOptions& options);

  /// The `count` best poses of `levelled_source`, no two within 2 cells and 3 steps of yaw, best
  /// first: correlative matching (Olson 2009) over all yaws and shifts, in whole numbers.
  std::vector<MapPeak> match(const Points& levelled_source, int count) const;

 private:
  using Sums = std::vector<std::int16_t>;
  using FewSums = std::vector<std::int8_t>;
  /// The index of the cell of a point; std::nullopt outside the map.
  std::optional<std::array<int, 3>> cell_of(const Eigen::Vector3d& point) const;
  void spread(const std::array<int, 3>& cell);
  /// Marks the cells between the sensor and a point, as far as they are not occupied.
  void clear_to(const Eigen::Vector3d& point, const Eigen::Vector3d& sensor);
  /// The shifts (row, column) whose sums are not below those of their four neighbours.
  std::vector<std::pair<int, int>> local_maxima(const Sums& sums) const;
  void add_window(FewSums& sums, int layer, int row, int column) const;
  Sums sums_at(const std::vector<Eigen::Vector3d>& centres, double yaw_rad) const;

  LayeredMapOptions options_;
  int reach_;       ///< Cells.
  int side_;        ///< Cells along x and y; the origin is in the middle.
  int window_;      ///< Shifts along one axis, 2 reach + 1.
  int stride_;      ///< The window, rounded up to whole vectors.
  int free_value_;  ///< Of a cell in free space; at most 0.
  std::vector<std::int8_t> cells_;
};

}  // namespace croon

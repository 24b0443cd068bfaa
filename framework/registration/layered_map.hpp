#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/params/table.hpp"
#include "framework/registration/sum_maxima.hpp"

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

/// How the cells of the maps with the same options are stored.
struct MapLayout {
  explicit MapLayout(const LayeredMapOptions& options);
  /// The index of a cell.
  int cell(int layer, int row, int column) const { return (layer * side + row) * side + column; }
  /// The index of the bound of the block of cells that begins there. Bounds whose blocks are side
  /// by side are neighbours.
  int bound(int layer, int row, int column) const;
  int size() const { return layers * side * side; }
  /// Shifts along one axis.
  int window() const { return 2 * reach + 1; }

  int layers;
  int reach;   ///< The maximum shift, in cells.
  int origin;  ///< Row and column of the cell at the origin.
  int side;    ///< Cells along x and along y, a multiple of kBlock.
};

/// The cells above the ground that a levelled cloud occupies, without duplicates (at most
/// `max_cells`, evenly spaced), turned by each yaw; for maps with the same options.
class TurnedCells {
 public:
  TurnedCells(const Points& levelled, const LayeredMapOptions& options);

 private:
  friend class LayeredMap;
  const int* cells_at(int yaw) const { return &cells_[static_cast<std::size_t>(yaw) * count_]; }
  const int* bounds_at(int yaw) const { return &bounds_[static_cast<std::size_t>(yaw) * count_]; }

  int yaws_;
  std::size_t count_;
  /// The indices in a MapLayout at the first shift, by yaw and then by cell: of cells and of
  /// bounds.
  std::vector<int> cells_;
  std::vector<int> bounds_;
};

/// The cells above the ground that a levelled cloud occupies (z up, ground at 0), dilated to their
/// neighbours for tolerance to shifts of half a cell, and with `free_space` those that it shows to
/// be free.
class LayeredMap {
 public:
  /// The sensor is above the origin at `height_m`.
  LayeredMap(const Points& levelled, double height_m, const LayeredMapOptions& options);

  /// The `count` best poses of the source, no two within 2 cells and 3 steps of yaw, best first:
  /// correlative matching (Olson 2009) over all yaws and shifts, in whole numbers. Those with a
  /// score below `min_score` may be left out, except for the first.
  std::vector<MapPeak> match(const TurnedCells& source, int count, double min_score = 0.0) const;

 private:
  /// The index of the cell of a point; std::nullopt outside the map.
  std::optional<std::array<int, 3>> cell_of(const Eigen::Vector3d& point) const;
  void spread(const std::array<int, 3>& cell);
  /// Marks the cells between the sensor and a point, as far as they are not occupied.
  void clear_to(const Eigen::Vector3d& point, const Eigen::Vector3d& sensor);
  /// Computes `columns_` and `bounds_`.
  void make_blocks();
  /// The bounds of BlockedSums: sums of the maxima of blocks.
  std::vector<int> bounds_of(const TurnedCells& source) const;
  BlockOfSums sums_of(const TurnedCells& source, int yaw, int row, int column) const;

  LayeredMapOptions options_;
  MapLayout layout_;
  int free_value_;   ///< Of a cell in free space; at most 0.
  std::size_t few_;  ///< Cells whose sum fits 8 bits, of which a vector register holds most.
  std::vector<std::int8_t> cells_;
  /// Each cell with the next kBlock - 1 in the direction of the rows: a block is in one piece.
  std::vector<std::array<std::int8_t, kBlock>> columns_;
  std::vector<std::int8_t> bounds_;  ///< Maxima of the blocks that begin at each cell.
};

}  // namespace croon

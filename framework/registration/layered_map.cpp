#include "framework/registration/layered_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "framework/base/angles.hpp"
#include "framework/spatial/evenly_spaced.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {
namespace {

constexpr int kFull = 4;   // Value of an occupied cell; neighbours have less.
constexpr int kLane = 16;  // Numbers per vector register.
/// Rows of bounds that are summed in registers; with the default options, all.
constexpr int kRows = 11;

/// A vector register.
using Lanes = std::int8_t __attribute__((vector_size(kLane)));
static_assert(kLane == kBlock * kBlock);

Lanes lanes_at(const void* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof(lanes));
  return lanes;
}

void add_to(int* sums, const Lanes& lanes) {
  for (int i = 0; i < kLane; ++i) sums[i] += lanes[i];
}

/// The layer of a point, a whole number: below 0 or above the last if it is outside the map.
double layer_of(const Eigen::Vector3d& point, const LayeredMapOptions& options) {
  return std::floor((point.z() - options.min_height_m) / options.cell_m);
}

int cells_within(double distance_m, const LayeredMapOptions& options) {
  return static_cast<int>(std::ceil(distance_m / options.cell_m));
}

/// The centres of the cells above the ground that contain points of the source, without duplicates;
/// at most `max_cells`, evenly spaced. z is the layer.
std::vector<Eigen::Vector3d> cell_centres(const Points& levelled,
                                          const LayeredMapOptions& options) {
  std::vector<std::array<int, 3>> cells;
  for (const Eigen::Vector3f& p : levelled) {
    const Eigen::Vector3d point = p.cast<double>();
    const double layer = layer_of(point, options);
    if (!(layer >= 0.0 && layer < options.layers)) continue;
    if (!(point.head<2>().norm() <= options.max_range_m)) continue;
    cells.push_back({static_cast<int>(layer), floor_of(point.x() / options.cell_m),
                     floor_of(point.y() / options.cell_m)});
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const std::size_t count = std::min(cells.size(), static_cast<std::size_t>(options.max_cells));
  std::vector<Eigen::Vector3d> centres;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [layer, x, y] = cells[evenly_spaced_index(i, cells.size(), count)];
    centres.emplace_back((x + 0.5) * options.cell_m, (y + 0.5) * options.cell_m, layer);
  }
  return centres;
}

/// Within 3 steps of yaw and 2 cells, with a margin for rounding.
bool is_near(const MapPeak& a, const MapPeak& b, const LayeredMapOptions& options) {
  const double turn = std::abs(std::remainder(a.yaw_rad - b.yaw_rad, 2.0 * kPi));
  const double shift = std::max(std::abs(a.x_m - b.x_m), std::abs(a.y_m - b.y_m));
  return turn <= 3.01 * rad_from_deg(options.yaw_step_deg) && shift <= 2.01 * options.cell_m;
}

}  // namespace

const params::Table<LayeredMapOptions>& layered_map_table() {
  static const params::Table<LayeredMapOptions> table = {
      params::number("cell_m", &LayeredMapOptions::cell_m, {0.2, 5.0},
                     "Edge of a cell of the map."),
      params::number("min_height_m", &LayeredMapOptions::min_height_m, {0.0, 5.0},
                     "Minimum height above the ground of points in the map."),
      params::integer("layers", &LayeredMapOptions::layers, {1, 20},
                      "Number of layers of the map, each cell_m high."),
      params::number("max_range_m", &LayeredMapOptions::max_range_m, {1.0, 100.0},
                     "Maximum range of the sensor's points in the map.")
          .formerly("radius_m"),
      params::number("max_sensor_distance_m", &LayeredMapOptions::max_sensor_distance_m,
                     {0.5, 30.0},
                     "Maximum distance of the sensor from the reference along x and along y.")
          .formerly("reach_m"),
      params::number("yaw_step_deg", &LayeredMapOptions::yaw_step_deg, {0.5, 30.0},
                     "Step between the yaws that are tried."),
      params::integer("max_cells", &LayeredMapOptions::max_cells, {10, 10000},
                      "Maximum number of cells of the sensor's map that are used."),
      params::number("free_space", &LayeredMapOptions::free_space, {0.0, 4.0},
                     "Cost of a cell of the sensor's map that the reference shows to be free, "
                     "relative to the value of one that coincides; 0 ignores free space."),
  };
  return table;
}

MapLayout::MapLayout(const LayeredMapOptions& options)
    : layers(options.layers),
      reach(cells_within(options.max_sensor_distance_m, options)),
      origin(cells_within(options.max_range_m, options) + reach + 2),
      // Blocks extend beyond the last shift.
      side((2 * origin + 2 * kBlock - 1) / kBlock * kBlock) {}

int MapLayout::bound(int layer, int row, int column) const {
  const int blocks = side / kBlock;
  const int phase = row % kBlock * kBlock + column % kBlock;
  return ((layer * kBlock * kBlock + phase) * blocks + row / kBlock) * blocks + column / kBlock;
}

TurnedCells::TurnedCells(const Points& levelled, const LayeredMapOptions& options)
    : yaws_(std::max(1, static_cast<int>(std::lround(360.0 / options.yaw_step_deg)))) {
  const std::vector<Eigen::Vector3d> centres = cell_centres(levelled, options);
  const MapLayout layout(options);
  const int first = layout.origin - layout.reach;
  count_ = centres.size();
  cells_.reserve(count_ * static_cast<std::size_t>(yaws_));
  bounds_.reserve(cells_.capacity());
  for (int k = 0; k < yaws_; ++k) {
    const double yaw_rad = 2.0 * kPi * k / yaws_;
    const double cosine = std::cos(yaw_rad);
    const double sine = std::sin(yaw_rad);
    for (const Eigen::Vector3d& p : centres) {
      const int column = floor_of((cosine * p.x() - sine * p.y()) / options.cell_m) + first;
      const int row = floor_of((sine * p.x() + cosine * p.y()) / options.cell_m) + first;
      const int layer = static_cast<int>(p.z());
      cells_.push_back(layout.cell(layer, row, column));
      bounds_.push_back(layout.bound(layer, row, column));
    }
  }
}

LayeredMap::LayeredMap(const Points& levelled, double height_m, const LayeredMapOptions& options)
    : options_(options),
      layout_(options),
      free_value_(-static_cast<int>(std::lround(kFull * options.free_space))),
      few_(static_cast<std::size_t>(std::numeric_limits<std::int8_t>::max() /
                                    std::max(kFull, -free_value_))),
      cells_(static_cast<std::size_t>(layout_.size())) {
  for (const Eigen::Vector3f& point : levelled) {
    if (const auto cell = cell_of(point.cast<double>())) spread(*cell);
  }
  if (free_value_ < 0) {
    for (const Eigen::Vector3f& point : levelled) {
      clear_to(point.cast<double>(), {0.0, 0.0, height_m});
    }
  }
  make_blocks();
}

std::optional<std::array<int, 3>> LayeredMap::cell_of(const Eigen::Vector3d& point) const {
  const double layer = layer_of(point, options_);
  const double row = std::floor(point.y() / options_.cell_m) + layout_.origin;
  const double column = std::floor(point.x() / options_.cell_m) + layout_.origin;
  if (!(layer >= 0.0 && layer < layout_.layers)) return std::nullopt;
  const int side = layout_.side;
  if (!(row >= 0.0 && row < side && column >= 0.0 && column < side)) return std::nullopt;
  return std::array<int, 3>{static_cast<int>(layer), static_cast<int>(row),
                            static_cast<int>(column)};
}

void LayeredMap::spread(const std::array<int, 3>& centre) {
  const auto& [layer, row, column] = centre;
  const auto at = [&](int l, int r, int c) -> std::int8_t& {
    return cells_[static_cast<std::size_t>(layout_.cell(l, r, c))];
  };
  if (at(layer, row, column) == kFull) return;
  const int side = layout_.side;
  for (int l = std::max(0, layer - 1); l <= std::min(layout_.layers - 1, layer + 1); ++l) {
    for (int r = std::max(0, row - 1); r <= std::min(side - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(side - 1, column + 1); ++c) {
        const int away = std::abs(l - layer) + std::abs(r - row) + std::abs(c - column);
        std::int8_t& cell = at(l, r, c);
        cell = std::max(cell, static_cast<std::int8_t>(kFull - away));
      }
    }
  }
}

void LayeredMap::clear_to(const Eigen::Vector3d& point, const Eigen::Vector3d& sensor) {
  const Eigen::Vector3d ray = point - sensor;
  const double range_m = ray.norm();
  const double step_m = 0.5 * options_.cell_m;
  for (double at_m = step_m; at_m < range_m - options_.cell_m; at_m += step_m) {
    const auto cell = cell_of(sensor + at_m / range_m * ray);
    if (!cell) continue;
    std::int8_t& here =
        cells_[static_cast<std::size_t>(layout_.cell((*cell)[0], (*cell)[1], (*cell)[2]))];
    if (here <= 0) here = static_cast<std::int8_t>(free_value_);
  }
}

void LayeredMap::make_blocks() {
  const auto size = cells_.size();
  const auto side = static_cast<std::size_t>(layout_.side);
  columns_.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < kBlock; ++k) {
      columns_[i][k] = i + k * side < size ? cells_[i + k * side] : std::int8_t{0};
    }
  }
  // Maxima of 2, then of 4 cells, along columns and rows.
  std::vector<std::int8_t> maxima = cells_;
  for (const std::size_t step : {std::size_t{1}, std::size_t{2}, side, 2 * side}) {
    for (std::size_t i = 0; i + step < size; ++i) maxima[i] = std::max(maxima[i], maxima[i + step]);
  }
  // Registers are filled beyond the last block.
  bounds_.resize(size + static_cast<std::size_t>(kRows * layout_.side / kBlock + kLane));
  std::size_t i = 0;
  for (int layer = 0; layer < layout_.layers; ++layer) {
    for (int row = 0; row < layout_.side; ++row) {
      for (int column = 0; column < layout_.side; ++column) {
        bounds_[static_cast<std::size_t>(layout_.bound(layer, row, column))] = maxima[i++];
      }
    }
  }
}

std::vector<int> LayeredMap::bounds_of(const TurnedCells& source) const {
  const int blocks = blocks_along(layout_.window());
  const int stride = layout_.side / kBlock;
  std::vector<int> bounds;
  std::vector<int> rows(kRows * kLane);
  const auto add_tile = [&](const int* indices, int row, int column) {
    const std::int8_t* const tile = &bounds_[row * stride + column];
    std::fill(rows.begin(), rows.end(), 0);
    for (std::size_t begin = 0; begin < source.count_; begin += few_) {
      const std::size_t end = std::min(source.count_, begin + few_);
      Lanes of_few[kRows] = {};
      for (std::size_t i = begin; i < end; ++i) {
        const std::int8_t* const from = tile + indices[i];
        for (int r = 0; r < kRows; ++r) of_few[r] += lanes_at(from + r * stride);
      }
      for (int r = 0; r < kRows; ++r) add_to(&rows[r * kLane], of_few[r]);
    }
  };
  for (int yaw = 0; yaw < source.yaws_; ++yaw) {
    const std::size_t first = bounds.size();
    bounds.resize(first + blocks * blocks);
    for (int row = 0; row < blocks; row += kRows) {
      for (int column = 0; column < blocks; column += kLane) {
        add_tile(source.bounds_at(yaw), row, column);
        for (int r = 0; r < std::min(kRows, blocks - row); ++r) {
          std::copy_n(&rows[r * kLane], std::min(kLane, blocks - column),
                      &bounds[first + (row + r) * blocks + column]);
        }
      }
    }
  }
  return bounds;
}

BlockOfSums LayeredMap::sums_of(const TurnedCells& source, int yaw, int row, int column) const {
  BlockOfSums sums{};
  const int* const indices = source.cells_at(yaw);
  const auto* const block =
      &columns_[static_cast<std::size_t>(layout_.cell(0, kBlock * row, kBlock * column))];
  for (std::size_t begin = 0; begin < source.count_; begin += few_) {
    const std::size_t end = std::min(source.count_, begin + few_);
    Lanes of_few = {};
    for (std::size_t i = begin; i < end; ++i) of_few += lanes_at(block + indices[i]);
    add_to(sums.data(), of_few);
  }
  return sums;
}

std::vector<MapPeak> LayeredMap::match(const TurnedCells& source, int count,
                                       double min_score) const {
  if (source.count_ == 0) return {};
  constexpr std::size_t kKeptPerYaw = 3;
  std::vector<MapPeak> best;
  std::vector<std::vector<MapPeak>> of_yaw(static_cast<std::size_t>(source.yaws_));
  const BlockedSums blocked = {
      source.yaws_, layout_.window(), bounds_of(source),
      [&](int yaw, int row, int column) { return sums_of(source, yaw, row, column); }};
  visit_maxima(blocked, [&](const SumMaximum& maximum) {
    const MapPeak peak = {2.0 * kPi * maximum.yaw / source.yaws_,
                          (maximum.column - layout_.reach) * options_.cell_m,
                          (maximum.row - layout_.reach) * options_.cell_m,
                          maximum.sum / (kFull * static_cast<double>(source.count_))};
    if (!best.empty() && peak.score < min_score) return false;
    const auto is_new = [&](const std::vector<MapPeak>& peaks) {
      return std::none_of(peaks.begin(), peaks.end(),
                          [&](const MapPeak& other) { return is_near(peak, other, options_); });
    };
    std::vector<MapPeak>& here = of_yaw[static_cast<std::size_t>(maximum.yaw)];
    if (here.size() == kKeptPerYaw || !is_new(here)) return true;
    here.push_back(peak);
    if (is_new(best)) best.push_back(peak);
    return static_cast<int>(best.size()) < count;
  });
  return best;
}

}  // namespace croon

#include "framework/registration/layered_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "framework/base/angles.hpp"
#include "framework/spatial/evenly_spaced.hpp"

namespace croon {
namespace {

constexpr int kFull = 4;   // Value of an occupied cell; neighbours have less.
constexpr int kLane = 16;  // Sums per vector register.

/// The index of (row, column) in rows of `columns` cells.
template <class Row>
std::size_t index(Row row, int columns, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(column);
}

/// The layer of a point, a whole number: below 0 or above the last if it is outside the map.
double layer_of(const Eigen::Vector3d& point, const LayeredMapOptions& options) {
  return std::floor((point.z() - options.min_height_m) / options.cell_m);
}

/// The centres of the cells above the ground that contain points of the source, without duplicates;
/// at most `max_cells`, evenly spaced.
std::vector<Eigen::Vector3d> cell_centres(const Points& levelled,
                                          const LayeredMapOptions& options) {
  std::set<std::tuple<int, int, int>> cells;
  for (const Eigen::Vector3f& p : levelled) {
    const Eigen::Vector3d point = p.cast<double>();
    const double layer = layer_of(point, options);
    if (!(layer >= 0.0 && layer < options.layers)) continue;
    if (!(point.head<2>().norm() <= options.max_range_m)) continue;
    cells.emplace(static_cast<int>(layer), static_cast<int>(std::floor(point.x() / options.cell_m)),
                  static_cast<int>(std::floor(point.y() / options.cell_m)));
  }
  const std::vector<std::tuple<int, int, int>> all(cells.begin(), cells.end());
  const std::size_t count = std::min(all.size(), static_cast<std::size_t>(options.max_cells));
  std::vector<Eigen::Vector3d> centres;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [layer, x, y] = all[evenly_spaced_index(i, all.size(), count)];
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

/// The best `count` of `peaks` that are not near each other.
std::vector<MapPeak> best_apart(std::vector<MapPeak> peaks, int count,
                                const LayeredMapOptions& options) {
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<MapPeak> best;
  for (const MapPeak& peak : peaks) {
    const bool is_new = std::none_of(best.begin(), best.end(), [&](const MapPeak& other) {
      return is_near(peak, other, options);
    });
    if (is_new) best.push_back(peak);
    if (static_cast<int>(best.size()) == count) break;
  }
  return best;
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

LayeredMap::LayeredMap(const Points& levelled, double height_m, const LayeredMapOptions& options)
    : options_(options),
      reach_(static_cast<int>(std::ceil(options.max_sensor_distance_m / options.cell_m))),
      side_(2 * (static_cast<int>(std::ceil(options.max_range_m / options.cell_m)) + reach_ + 2)),
      window_(2 * reach_ + 1),
      stride_((window_ + kLane - 1) / kLane * kLane),
      free_value_(-static_cast<int>(std::lround(kFull * options.free_space))),
      cells_(index(index(options.layers, side_, 0), side_, 0) + index(1, stride_, 0)) {
  for (const Eigen::Vector3f& point : levelled) {
    if (const auto cell = cell_of(point.cast<double>())) spread(*cell);
  }
  if (free_value_ == 0) return;
  for (const Eigen::Vector3f& point : levelled) {
    clear_to(point.cast<double>(), {0.0, 0.0, height_m});
  }
}

std::optional<std::array<int, 3>> LayeredMap::cell_of(const Eigen::Vector3d& point) const {
  const double layer = layer_of(point, options_);
  const int middle = side_ / 2;
  const double row = std::floor(point.y() / options_.cell_m) + middle;
  const double column = std::floor(point.x() / options_.cell_m) + middle;
  if (!(layer >= 0.0 && layer < options_.layers)) return std::nullopt;
  if (!(row >= 0.0 && row < side_ && column >= 0.0 && column < side_)) return std::nullopt;
  return std::array<int, 3>{static_cast<int>(layer), static_cast<int>(row),
                            static_cast<int>(column)};
}

void LayeredMap::spread(const std::array<int, 3>& centre) {
  const auto& [layer, row, column] = centre;
  for (int l = std::max(0, layer - 1); l <= std::min(options_.layers - 1, layer + 1); ++l) {
    for (int r = std::max(0, row - 1); r <= std::min(side_ - 1, row + 1); ++r) {
      for (int c = std::max(0, column - 1); c <= std::min(side_ - 1, column + 1); ++c) {
        const int away = std::abs(l - layer) + std::abs(r - row) + std::abs(c - column);
        std::int8_t& cell = cells_[index(index(l, side_, r), side_, c)];
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
    std::int8_t& here = cells_[index(index((*cell)[0], side_, (*cell)[1]), side_, (*cell)[2])];
    if (here <= 0) here = static_cast<std::int8_t>(free_value_);
  }
}

/// Adds the cells around (row, column), one per shift.
void LayeredMap::add_window(FewSums& sums, int layer, int row, int column) const {
  for (int shift = 0; shift < window_; ++shift) {
    const std::size_t line = index(layer, side_, row - reach_ + shift);
    const std::int8_t* const from = &cells_[index(line, side_, column - reach_)];
    // Bytes may alias anything, which would keep the compiler from using vectors.
    std::int8_t* const __restrict to = &sums[index(shift, stride_, 0)];
    const int count = stride_;
    for (int i = 0; i < count; ++i) to[i] = static_cast<std::int8_t>(to[i] + from[i]);
  }
}

/// The sums at each shift of the cells around the points `centres`, turned by `yaw_rad`.
LayeredMap::Sums LayeredMap::sums_at(const std::vector<Eigen::Vector3d>& centres,
                                     double yaw_rad) const {
  const double cosine = std::cos(yaw_rad);
  const double sine = std::sin(yaw_rad);
  Sums sums(index(window_, stride_, 0));
  // Eight bits hold the sums of a few cells, and twice as many of them fit into a register.
  const int few = std::numeric_limits<std::int8_t>::max() / std::max(kFull, -free_value_);
  FewSums of_few(sums.size());
  for (std::size_t begin = 0; begin < centres.size(); begin += static_cast<std::size_t>(few)) {
    const std::size_t end = std::min(centres.size(), begin + static_cast<std::size_t>(few));
    std::fill(of_few.begin(), of_few.end(), std::int8_t{0});
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d& p = centres[i];
      const double x = (cosine * p.x() - sine * p.y()) / options_.cell_m;
      const double y = (sine * p.x() + cosine * p.y()) / options_.cell_m;
      add_window(of_few, static_cast<int>(p.z()), static_cast<int>(std::floor(y)) + side_ / 2,
                 static_cast<int>(std::floor(x)) + side_ / 2);
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] = static_cast<std::int16_t>(sums[i] + of_few[i]);
    }
  }
  return sums;
}

std::vector<std::pair<int, int>> LayeredMap::local_maxima(const Sums& sums) const {
  const auto at = [&](int row, int column) { return sums[index(row, stride_, column)]; };
  std::vector<std::pair<int, int>> maxima;
  for (int row = 0; row < window_; ++row) {
    for (int column = 0; column < window_; ++column) {
      const std::int16_t sum = at(row, column);
      if (sum <= 0) continue;
      if (row > 0 && at(row - 1, column) > sum) continue;
      if (row + 1 < window_ && at(row + 1, column) > sum) continue;
      if (column > 0 && at(row, column - 1) > sum) continue;
      if (column + 1 < window_ && at(row, column + 1) > sum) continue;
      maxima.emplace_back(row, column);
    }
  }
  return maxima;
}

std::vector<MapPeak> LayeredMap::match(const Points& levelled_source, int count) const {
  const std::vector<Eigen::Vector3d> centres = cell_centres(levelled_source, options_);
  if (centres.empty()) return {};
  constexpr int kKeptPerYaw = 3;
  std::vector<MapPeak> peaks;
  const int yaws = std::max(1, static_cast<int>(std::lround(360.0 / options_.yaw_step_deg)));
  for (int k = 0; k < yaws; ++k) {
    const double yaw_rad = 2.0 * kPi * k / yaws;
    const Sums sums = sums_at(centres, yaw_rad);
    std::vector<MapPeak> of_yaw;
    for (const auto& [row, column] : local_maxima(sums)) {
      of_yaw.push_back(
          {yaw_rad, (column - reach_) * options_.cell_m, (row - reach_) * options_.cell_m,
           sums[index(row, stride_, column)] / (kFull * static_cast<double>(centres.size()))});
    }
    for (const MapPeak& peak : best_apart(std::move(of_yaw), kKeptPerYaw, options_)) {
      peaks.push_back(peak);
    }
  }
  return best_apart(std::move(peaks), count, options_);
}

}  // namespace croon

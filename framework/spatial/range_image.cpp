#include "framework/spatial/range_image.hpp"

#include <algorithm>
#include <cmath>

namespace croon {

RangeImage::RangeImage(const Points& points, int cells)
    : cells_(cells),
      returns_(std::size_t{6} * static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells)) {
  for (const Eigen::Vector3f& point : points) {
    const float range_m = point.norm();
    if (!(range_m > 0.0F) || !std::isfinite(range_m)) continue;
    Seen& seen = returns_[index_of(cell_of(point.cast<double>()))];
    if (seen.farthest_m == 0.0F || range_m < seen.nearest_m) seen.nearest_m = range_m;
    seen.farthest_m = std::max(seen.farthest_m, range_m);
  }
}

RangeImage::Cell RangeImage::cell_of(const Eigen::Vector3d& point) const {
  int axis = 0;
  const double largest = point.cwiseAbs().maxCoeff(&axis);
  if (!(largest > 0.0)) return {};
  const auto share = [&](int other) {
    const double value = 0.5 * (point(other) / largest + 1.0) * cells_;
    return std::clamp(static_cast<int>(value), 0, cells_ - 1);
  };
  return {2 * axis + (point(axis) > 0.0 ? 1 : 0), share((axis + 1) % 3), share((axis + 2) % 3)};
}

std::size_t RangeImage::index_of(const Cell& cell) const {
  const auto cells = static_cast<std::size_t>(cells_);
  return (static_cast<std::size_t>(cell.face) * cells + static_cast<std::size_t>(cell.row)) *
             cells +
         static_cast<std::size_t>(cell.column);
}

std::optional<RangeImage::Seen> RangeImage::at(const Eigen::Vector3d& point) const {
  const Cell centre = cell_of(point);
  Seen all = returns_[index_of(centre)];
  if (all.farthest_m == 0.0F) return std::nullopt;
  for (int row = std::max(0, centre.row - 1); row <= std::min(cells_ - 1, centre.row + 1); ++row) {
    for (int column = std::max(0, centre.column - 1);
         column <= std::min(cells_ - 1, centre.column + 1); ++column) {
      const Seen& seen = returns_[index_of({centre.face, row, column})];
      if (seen.farthest_m == 0.0F) continue;
      all.nearest_m = std::min(all.nearest_m, seen.nearest_m);
      all.farthest_m = std::max(all.farthest_m, seen.farthest_m);
    }
  }
  return all;
}

}  // namespace croon

#include "framework/spatial/vehicle_sized.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace croon {
namespace {

using GroundCell = std::array<int, 2>;

/// The points in a cell of the ground plane.
struct GroundColumn {
  std::vector<int> points;
  double height_m = 0.0;  ///< Of its highest point.
  bool is_seen = false;
};

/// The points of neighbouring columns, and the height of the highest.
struct GroundObject {
  std::vector<int> points;
  double height_m = 0.0;
};

/// The object that extends from column `first` over all its neighbours.
GroundObject object_from(std::map<GroundCell, GroundColumn>& columns, const GroundCell& first) {
  GroundObject object;
  std::vector<GroundCell> open = {first};
  columns.at(first).is_seen = true;
  while (!open.empty()) {
    const GroundCell cell = open.back();
    open.pop_back();
    const GroundColumn& column = columns.at(cell);
    object.points.insert(object.points.end(), column.points.begin(), column.points.end());
    object.height_m = std::max(object.height_m, column.height_m);
    for (int du = -1; du <= 1; ++du) {
      for (int dv = -1; dv <= 1; ++dv) {
        const auto next = columns.find({cell[0] + du, cell[1] + dv});
        if (next == columns.end() || next->second.is_seen) continue;
        next->second.is_seen = true;
        open.push_back(next->first);
      }
    }
  }
  return object;
}

/// The length and width of the points, along their principal axes.
Eigen::Vector2d extent_m(const std::vector<int>& points, const std::vector<Eigen::Vector2d>& plan) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const int i : points) mean += plan[i] / static_cast<double>(points.size());
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const int i : points) spread += (plan[i] - mean) * (plan[i] - mean).transpose();
  const Eigen::Matrix2d axes =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvectors();
  Eigen::Vector2d least = Eigen::Vector2d::Constant(1e9), most = -least;
  for (const int i : points) {
    const Eigen::Vector2d along = axes.transpose() * (plan[i] - mean);
    least = least.cwiseMin(along);
    most = most.cwiseMax(along);
  }
  return {(most - least)(1), (most - least)(0)};
}

}  // namespace

std::vector<bool> is_vehicle_sized(const Points& points, const Plane& ground,
                                   const VehicleSize& options) {
  const Eigen::Vector3d up = ground.normal;
  const Eigen::Vector3d u = up.unitOrthogonal(), v = up.cross(u);
  std::vector<Eigen::Vector2d> plan(points.size());
  std::map<GroundCell, GroundColumn> columns;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d p = points[i].cast<double>();
    plan[i] = {u.dot(p), v.dot(p)};
    const double height_m = ground.signed_distance(p);
    if (!(height_m >= options.min_height_m && plan[i].norm() <= options.max_range_m)) continue;
    const GroundCell cell = {static_cast<int>(std::floor(plan[i].x() / options.cell_m)),
                             static_cast<int>(std::floor(plan[i].y() / options.cell_m))};
    GroundColumn& column = columns[cell];
    column.points.push_back(static_cast<int>(i));
    column.height_m = std::max(column.height_m, height_m);
  }
  std::vector<bool> result(points.size(), false);
  for (const auto& [cell, column] : columns) {
    if (column.is_seen) continue;
    const GroundObject object = object_from(columns, cell);
    if (object.height_m > options.max_height_m) continue;
    const Eigen::Vector2d size_m = extent_m(object.points, plan);
    if (size_m(0) < options.min_length_m || size_m(0) > options.max_length_m ||
        size_m(1) > options.max_width_m) {
      continue;
    }
    for (const int i : object.points) result[i] = true;
  }
  return result;
}

}  // namespace croon

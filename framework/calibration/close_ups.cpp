#include "framework/calibration/close_ups.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "framework/base/text.hpp"

namespace croon {
namespace {

/// The points of a vertical column of the scene, in the level frame.
struct GroundCell {
  std::vector<Eigen::Vector3d> points;
  std::map<std::size_t, std::size_t> by_sensor;  ///< Numbers of points.
};

using CellIndex = std::pair<int, int>;

constexpr double kColumn_m = 1.0;
constexpr double kLowest_m = 0.4, kHighest_m = 6.0;
constexpr double kNearestCloseUp_m = 4.0, kFarthestCloseUp_m = 45.0;

/// The columns of points above the ground, from all sensors that are not rejected, or from all
/// sensors if all but the reference are rejected.
std::map<CellIndex, GroundCell> cells_of(const RigView& view) {
  const bool is_any_accepted = std::any_of(
      view.sensors.begin(), view.sensors.end(),
      [](const ViewedSensor& sensor) { return !sensor.is_reference && sensor.is_accepted; });
  std::map<CellIndex, GroundCell> cells;
  for (std::size_t s = 0; s < view.sensors.size(); ++s) {
    const ViewedSensor& sensor = view.sensors[s];
    if (!sensor.poses.back() || (is_any_accepted && !sensor.is_accepted)) continue;
    for (const Eigen::Vector3f& own : sensor.points) {
      const Eigen::Vector3d p = *sensor.poses.back() * own.cast<double>().eval();
      const double range_m = std::hypot(p.x(), p.y());
      if (range_m < kNearestCloseUp_m || range_m > kFarthestCloseUp_m) continue;
      if (view.level.has_ground && (p.z() < kLowest_m || p.z() > kHighest_m)) continue;
      GroundCell& cell = cells[{static_cast<int>(std::floor(p.x() / kColumn_m)),
                                static_cast<int>(std::floor(p.y() / kColumn_m))}];
      cell.points.push_back(p);
      ++cell.by_sensor[s];
    }
  }
  return cells;
}

/// The horizontal shape of the points of a column.
struct ColumnShape {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double length_m = 0.0, breadth_m = 0.0;  ///< Standard deviations along the principal axes.
  double height_m = 0.0;
  Eigen::Vector2d across = Eigen::Vector2d::Zero();  ///< The axis of the breadth.
};

ColumnShape shape_of(const std::vector<Eigen::Vector3d>& points) {
  ColumnShape shape;
  double low_m = points.front().z(), high_m = low_m;
  for (const Eigen::Vector3d& p : points) {
    shape.centre_m += p / static_cast<double>(points.size());
    low_m = std::min(low_m, p.z());
    high_m = std::max(high_m, p.z());
  }
  shape.height_m = high_m - low_m;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector2d off = (p - shape.centre_m).head<2>();
    covariance += off * off.transpose() / static_cast<double>(points.size());
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
  shape.breadth_m = std::sqrt(std::max(0.0, solver.eigenvalues()(0)));
  shape.length_m = std::sqrt(std::max(0.0, solver.eigenvalues()(1)));
  shape.across = solver.eigenvectors().col(0);
  return shape;
}

/// The number of points in the eight columns around a column.
std::size_t points_around(const std::map<CellIndex, GroundCell>& cells, const CellIndex& index) {
  std::size_t count = 0;
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      const auto found = cells.find({index.first + dx, index.second + dy});
      if ((dx != 0 || dy != 0) && found != cells.end()) count += found->second.points.size();
    }
  }
  return count;
}

/// Whether a second sensor confirms the column.
bool is_shared(const GroundCell& cell) {
  const auto has_enough = [](const auto& count) { return count.second >= 8; };
  return std::count_if(cell.by_sensor.begin(), cell.by_sensor.end(), has_enough) > 1;
}

enum CloseUpKind : std::size_t { kWall, kEdge, kPole, kCloseUpKinds };
constexpr std::array<const char*, kCloseUpKinds> kKindNames = {"wall", "vertical edge", "pole"};

/// The kind of place and its score; a negative score if the column is not suitable.
std::pair<CloseUpKind, double> judged(const ColumnShape& shape, std::size_t own,
                                      std::size_t around) {
  constexpr double kTall_m = 1.2;
  const double range_m = shape.centre_m.head<2>().norm();
  if (shape.height_m < kTall_m) return {kWall, -1.0};
  if (shape.length_m < 0.16 && 2 * around < own) return {kPole, range_m};
  // Seen head-on, a wall shows errors of distance; the standard deviation is that of a thin wall.
  const double cosine = std::abs(shape.across.dot(shape.centre_m.head<2>().normalized()));
  if (shape.breadth_m < 0.05 && shape.length_m > 0.2) return {kWall, range_m * cosine * cosine};
  // Two walls that meet fill a triangle of the column.
  if (shape.breadth_m > 0.1 && shape.breadth_m < 0.25 && shape.length_m > 0.25) {
    return {kEdge, range_m};
  }
  return {kWall, -1.0};
}

}  // namespace

std::vector<CloseUp> close_ups(const RigView& view) {
  constexpr double kHalfWidth_m = 2.0;
  const std::map<CellIndex, GroundCell> cells = cells_of(view);
  std::array<double, kCloseUpKinds> best{};
  std::array<CloseUp, kCloseUpKinds> chosen;
  for (const auto& [index, cell] : cells) {
    if (!is_shared(cell)) continue;
    const ColumnShape shape = shape_of(cell.points);
    const auto [kind, score] = judged(shape, cell.points.size(), points_around(cells, index));
    if (score <= best.at(kind)) continue;
    best.at(kind) = score;
    const double range_m = shape.centre_m.head<2>().norm();
    chosen.at(kind) = {
        std::string(kKindNames.at(kind)) + ", " + fixed_number(range_m, 0) + " m away",
        shape.centre_m, kHalfWidth_m};
  }
  std::vector<CloseUp> found;
  for (const CloseUp& place : chosen) {
    if (!place.title.empty()) found.push_back(place);
  }
  return found;
}

}  // namespace croon

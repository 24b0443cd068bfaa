#include "framework/simulation/objects/profiles.hpp"

#include <algorithm>
#include <cmath>

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The level direction from `from` to `to`.
Vector3d direction(const Vector3d& from, const Vector3d& to) {
  return Vector3d(to.x() - from.x(), to.y() - from.y(), 0.0).normalized();
}

Vector3d left_of(const Vector3d& from, const Vector3d& to) {
  return PathPoint{from, direction(from, to)}.left();
}

/// The vector to the left at the point `i`, scaled so that the pieces on either side have a
/// thickness of 1.
Vector3d mitre(const Path& path, std::size_t i) {
  constexpr double kMaxLength = 2.0;  // Sharp corners are cut off.
  const std::size_t last = path.size() - 1;
  const Vector3d before = left_of(path[i > 0 ? i - 1 : 0], path[i > 0 ? i : 1]);
  const Vector3d after = left_of(path[i < last ? i : last - 1], path[std::min(i + 1, last)]);
  const Vector3d middle = (before + after).normalized();
  return middle * std::min(kMaxLength, 1.0 / std::max(middle.dot(before), 1e-9));
}

}  // namespace

Profile box_profile(const Vector2d& low, const Vector2d& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

std::vector<Ring> rings_along(const Path& path, const Profile& profile) {
  std::vector<Ring> rings(path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector3d left = mitre(path, i);
    for (const Vector2d& corner : profile) {
      rings[i].push_back(path[i] + corner.x() * left + corner.y() * Vector3d::UnitZ());
    }
  }
  return rings;
}

std::vector<PathPoint> points_along(const Path& path, double step_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / step_m)));
  std::vector<PathPoint> points;
  double from_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector3d way = path[i] - path[i - 1];
    const double piece_m = way.norm();
    const bool is_last = i + 1 == path.size();
    for (auto next = static_cast<int>(points.size()); next <= steps; ++next) {
      const double at_m = length_m * next / steps - from_m;
      if (at_m >= piece_m && !is_last) break;
      points.push_back({path[i - 1] + at_m / piece_m * way, direction(path[i - 1], path[i])});
    }
    from_m += piece_m;
  }
  return points;
}

void add_pillar(Mesh& mesh, const PathPoint& point, const Vector2d& half_m, double low_m,
                double high_m, Material material) {
  const Vector3d along = half_m.x() * point.along;
  const Vector3d across = half_m.y() * point.left();
  std::vector<Ring> rings;
  for (const double z_m : {low_m, high_m}) {
    const Vector3d middle = point.position + z_m * Vector3d::UnitZ();
    rings.push_back({middle - along - across, middle + along - across, middle + along + across,
                     middle - along + across});
  }
  add_loft(mesh, rings, material);
}

Vector3d OverRoad::point(double s_m, double d_m, double above_m) const {
  const RoadShape& shape = ground_.shape();
  const double kerb_m = shape.half_width_m;
  Vector3d result = ground_.point(s_m, d_m);
  if (above_m < 0.0) {
    result.z() = shape.height_m(s_m, d_m) + above_m;
  } else {
    result.z() = std::max({shape.height_m(s_m, -kerb_m), shape.height_m(s_m, 0.0),
                           shape.height_m(s_m, kerb_m)}) +
                 above_m;
  }
  return result;
}

std::vector<Ring> OverRoad::rings(const std::vector<double>& stations_m,
                                  const Profile& profile) const {
  std::vector<Ring> rings;
  for (const double s_m : stations_m) {
    Ring& ring = rings.emplace_back();
    for (const Vector2d& corner : profile) ring.push_back(point(s_m, corner.x(), corner.y()));
  }
  return rings;
}

std::vector<double> stations_between(const Span& span_m) {
  constexpr double kSegment_m = 5.0;
  const int segments = std::max(1, static_cast<int>(std::ceil(span_m.length() / kSegment_m)));
  std::vector<double> stations_m;
  for (int i = 0; i < segments; ++i) {
    stations_m.push_back(span_m.from + span_m.length() * i / segments);
  }
  stations_m.push_back(span_m.to);
  return stations_m;
}

}  // namespace croon::simulation

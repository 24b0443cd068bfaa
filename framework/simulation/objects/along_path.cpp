#include "framework/simulation/objects/along_path.hpp"

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

Vector3d left_of(const Vector3d& along) { return {-along.y(), along.x(), 0.0}; }

/// The way to the left at the corner `i`, long enough for pieces of thickness 1 on either side.
Vector3d mitre(const Path& path, std::size_t i) {
  constexpr double kLongest = 2.0;  // A sharp corner is cut off.
  const std::size_t last = path.size() - 1;
  const Vector3d before = left_of(direction(path[i > 0 ? i - 1 : 0], path[i > 0 ? i : 1]));
  const Vector3d after =
      left_of(direction(path[i < last ? i : last - 1], path[std::min(i + 1, last)]));
  const Vector3d middle = (before + after).normalized();
  return middle * std::min(kLongest, 1.0 / std::max(middle.dot(before), 1e-9));
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

void add_strip(Mesh& mesh, const std::vector<Ring>& rings, Material material) {
  const auto count = static_cast<std::uint32_t>(rings.front().size());
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Ring& ring : rings) {
    for (const Vector3d& corner : ring) mesh.add_vertex(corner);
  }
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size()) - count;
  for (std::uint32_t ring = first; ring < last; ring += count) {
    for (std::uint32_t corner = ring; corner + 1 < ring + count; ++corner) {
      mesh.add_quad(corner, corner + 1, corner + count + 1, corner + count, material);
    }
  }
}

std::vector<PathPlace> places_along(const Path& path, double step_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) length_m += (path[i] - path[i - 1]).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / step_m)));
  std::vector<PathPlace> places;
  double from_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vector3d way = path[i] - path[i - 1];
    const double piece_m = way.norm();
    const bool is_last = i + 1 == path.size();
    for (auto next = static_cast<int>(places.size()); next <= steps; ++next) {
      const double at_m = length_m * next / steps - from_m;
      if (at_m >= piece_m && !is_last) break;
      places.push_back({path[i - 1] + at_m / piece_m * way, direction(path[i - 1], path[i])});
    }
    from_m += piece_m;
  }
  return places;
}

void add_pillar(Mesh& mesh, const PathPlace& place, const Vector2d& half_m, double low_m,
                double high_m, Material material) {
  const Vector3d along = half_m.x() * place.along;
  const Vector3d across = half_m.y() * left_of(place.along);
  std::vector<Ring> rings;
  for (const double z_m : {low_m, high_m}) {
    const Vector3d middle = place.foot + z_m * Vector3d::UnitZ();
    rings.push_back({middle - along - across, middle + along - across, middle + along + across,
                     middle - along + across});
  }
  add_loft(mesh, rings, material);
}

}  // namespace croon::simulation

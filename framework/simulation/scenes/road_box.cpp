#include "framework/simulation/scenes/road_box.hpp"

#include <algorithm>
#include <cmath>

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// `box` of an object's frame, at `place`.
RoadBox at_place(const RoadBox& box, const Place& place, double curvature_per_m) {
  if (box.isEmpty()) return box;
  const Eigen::AngleAxisd turn(place.yaw_rad, Vector3d::UnitZ());
  RoadBox turned;
  for (int corner = 0; corner < 8; ++corner) {
    turned.extend(turn * box.corner(static_cast<RoadBox::CornerType>(corner)));
  }
  const double half_m = 0.5 * turned.sizes().x();
  // A straight side of 2 h leaves an arc by h^2 curvature / 2.
  const double bulge_m = 0.5 * half_m * half_m * std::abs(curvature_per_m);
  const Vector3d foot(0.0, place.d_m, 0.0);
  RoadBox moved(turned.min() + foot, turned.max() + foot);
  const double ratio = bend_ratio(curvature_per_m, {moved.min().y(), moved.max().y()});
  moved.min().x() = place.s_m + ratio * turned.min().x();
  moved.max().x() = place.s_m + ratio * turned.max().x();
  (curvature_per_m > 0.0 ? moved.min() : moved.max()).y() +=
      curvature_per_m > 0.0 ? -bulge_m : bulge_m;
  return moved;
}

}  // namespace

RoadBox road_box(const Interval& along_m, const Interval& across_m, double height_m) {
  return {Vector3d(along_m.from_m, across_m.from_m, 0.0),
          Vector3d(along_m.to_m, across_m.to_m, height_m)};
}

double bend_ratio(double curvature_per_m, const Interval& across_m) {
  const double inmost =
      std::max(curvature_per_m * across_m.from_m, curvature_per_m * across_m.to_m);
  return 1.0 / std::max(1.0 - inmost, 0.2);
}

std::array<RoadBox, 2> boxes_of(const Mesh& mesh, const Place& place, double curvature_per_m) {
  std::array<Eigen::AlignedBox3f, 2> parts;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    parts[vertex.z() < static_cast<float>(kHeadroom_m) ? 0 : 1].extend(vertex);
  }
  std::array<RoadBox, 2> boxes;
  for (std::size_t i = 0; i < 2; ++i) {
    boxes[i] = at_place(parts[i].cast<double>(), place, curvature_per_m);
  }
  // What has a part above and one below is between them too.
  if (!boxes[0].isEmpty() && !boxes[1].isEmpty()) {
    boxes[0].max().z() = kHeadroom_m;
    boxes[1].min().z() = kHeadroom_m;
  }
  return boxes;
}

bool Occupancy::is_free(const RoadBox& box) const {
  return std::none_of(taken_.begin(), taken_.end(), [&](const RoadBox& other) {
    // Neighbours may touch.
    return (box.min().array() < other.max().array()).all() &&
           (other.min().array() < box.max().array()).all();
  });
}

}  // namespace croon::simulation

#include "framework/simulation/scenes/road_coordinates.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// Maximum length in s per metre, between the two d of `across_m`, on a road with
/// `curvature_per_m`.
double bend_ratio(double curvature_per_m, const Span& across_m) {
  const double inmost = std::max(curvature_per_m * across_m.from, curvature_per_m * across_m.to);
  return 1.0 / std::max(1.0 - inmost, 0.2);
}

/// The road box around `box`, which is in the frame of an object at `pose`.
RoadBox box_at(const RoadBox& box, const RoadPose& pose, double curvature_per_m) {
  if (box.isEmpty()) return box;
  const Eigen::AngleAxisd turn(pose.yaw_rad, Vector3d::UnitZ());
  RoadBox turned;
  for (int corner = 0; corner < 8; ++corner) {
    turned.extend(turn * box.corner(static_cast<RoadBox::CornerType>(corner)));
  }
  const double half_m = 0.5 * turned.sizes().x();
  // A straight side of length 2 h deviates from an arc by h^2 curvature / 2.
  const double bulge_m = 0.5 * half_m * half_m * std::abs(curvature_per_m);
  const Vector3d foot(0.0, pose.d_m, 0.0);
  RoadBox moved(turned.min() + foot, turned.max() + foot);
  const double ratio = bend_ratio(curvature_per_m, {moved.min().y(), moved.max().y()});
  moved.min().x() = pose.s_m + ratio * turned.min().x();
  moved.max().x() = pose.s_m + ratio * turned.max().x();
  (curvature_per_m > 0.0 ? moved.min() : moved.max()).y() +=
      curvature_per_m > 0.0 ? -bulge_m : bulge_m;
  return moved;
}

}  // namespace

RoadBox road_box(const Span& along_m, const Span& across_m, double height_m) {
  return {Vector3d(along_m.from, across_m.from, 0.0), Vector3d(along_m.to, across_m.to, height_m)};
}

std::array<RoadBox, 2> boxes_of(const Mesh& mesh, const RoadPose& pose, double curvature_per_m) {
  std::array<Eigen::AlignedBox3f, 2> parts;
  for (const Eigen::Vector3f& vertex : mesh.vertices) {
    parts[vertex.z() < static_cast<float>(kHeadroom_m) ? 0 : 1].extend(vertex);
  }
  std::array<RoadBox, 2> boxes;
  for (std::size_t i = 0; i < 2; ++i) {
    boxes[i] = box_at(parts[i].cast<double>(), pose, curvature_per_m);
  }
  // An object with both parts also occupies the space between them.
  if (!boxes[0].isEmpty() && !boxes[1].isEmpty()) {
    boxes[0].max().z() = kHeadroom_m;
    boxes[1].min().z() = kHeadroom_m;
  }
  return boxes;
}

bool Occupancy::is_free(const RoadBox& box) const {
  return std::none_of(taken_.begin(), taken_.end(), [&](const RoadBox& other) {
    return (box.min().array() < other.max().array()).all() &&
           (other.min().array() < box.max().array()).all();
  });
}

RoadPose Roadside::at(double along_m, double out_m, double turn_rad) const {
  if (is_across) {
    return {crossing_s_m + sign * out_m, along_m, -0.5 * kPi * sign + turn_rad};
  }
  return {along_m, sign * out_m, (sign > 0.0 ? 0.0 : kPi) + turn_rad};
}

RoadBox Roadside::box(const Span& along_m, const Span& out_m, double height_m) const {
  const RoadPose from = at(along_m.from, out_m.from);
  const RoadPose to = at(along_m.to, out_m.to);
  return road_box({std::min(from.s_m, to.s_m), std::max(from.s_m, to.s_m)},
                  {std::min(from.d_m, to.d_m), std::max(from.d_m, to.d_m)}, height_m);
}

double Roadside::along_of(const RoadShape& shape, double length_m, const Span& out_m) const {
  if (is_across) return length_m;
  return length_m * bend_ratio(shape.curvature_per_m, {sign * out_m.from, sign * out_m.to});
}

std::array<Roadside, 2> both_sides() {
  Roadside left;
  Roadside right;
  right.sign = -1.0;
  return {left, right};
}

}  // namespace croon::simulation

#include "framework/simulation/objects/solids.hpp"

#include <cmath>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Shuts the convex ring of `count` vertices from `first`.
void add_end(Mesh& mesh, std::uint32_t first, std::uint32_t count, Material material) {
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    mesh.add_triangle(first, first + i, first + i + 1, material);
  }
}

Ring ring_of(const Level& level) {
  const auto& [z_m, rear_m, front_m, half_width_m] = level;
  return {{rear_m, -half_width_m, z_m},
          {front_m, -half_width_m, z_m},
          {front_m, half_width_m, z_m},
          {rear_m, half_width_m, z_m}};
}

}  // namespace

void add_loft(Mesh& mesh, const std::vector<Ring>& rings, Material material) {
  const auto count = static_cast<std::uint32_t>(rings.front().size());
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Ring& ring : rings) {
    for (const Vector3d& corner : ring) mesh.add_vertex(corner);
  }
  const auto last = static_cast<std::uint32_t>(mesh.vertices.size()) - count;
  for (std::uint32_t ring = first; ring < last; ring += count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t next = (i + 1) % count;
      mesh.add_quad(ring + i, ring + next, ring + count + next, ring + count + i, material);
    }
  }
  add_end(mesh, first, count, material);
  add_end(mesh, last, count, material);
}

void add_plate(Mesh& mesh, const Vector3d& front, const std::vector<Vector2d>& outline,
               double thickness_m, Material material) {
  std::vector<Ring> rings(2);
  for (const Vector2d& yz : outline) {
    rings[0].push_back(front + Vector3d(0.0, yz.x(), yz.y()));
    rings[1].push_back(front + Vector3d(-thickness_m, yz.x(), yz.y()));
  }
  add_loft(mesh, rings, material);
}

std::vector<Vector2d> rectangle(double width_m, double height_m) {
  const double y = 0.5 * width_m;
  const double z = 0.5 * height_m;
  return {{-y, -z}, {y, -z}, {y, z}, {-y, z}};
}

std::vector<Vector2d> regular_polygon(double radius_m, int corners) {
  std::vector<Vector2d> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * kPi * i / corners;
    outline.emplace_back(radius_m * std::sin(angle), radius_m * std::cos(angle));
  }
  return outline;
}

Level between(const Level& low, const Level& high, double ratio) {
  const auto mix = [&](double Level::*member) {
    return (1.0 - ratio) * low.*member + ratio * high.*member;
  };
  return {mix(&Level::z_m), mix(&Level::rear_m), mix(&Level::front_m), mix(&Level::half_width_m)};
}

void add_stack(Mesh& mesh, const std::vector<Level>& levels, Material material) {
  std::vector<Ring> rings;
  for (const Level& level : levels) rings.push_back(ring_of(level));
  add_loft(mesh, rings, material);
}

std::vector<Span> without(const Span& whole, const std::vector<Span>& holes) {
  std::vector<Span> rest;
  double from = whole.from;
  for (const Span& hole : holes) {
    if (hole.from > from) rest.push_back({from, hole.from});
    from = hole.to;
  }
  if (whole.to > from) rest.push_back({from, whole.to});
  return rest;
}

}  // namespace croon::simulation

#include <array>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Uniform in the unit ball, by rejection.
Vector3d draw_in_ball(Rng& rng) {
  for (;;) {
    const double x = rng.uniform(-1.0, 1.0);
    const double y = rng.uniform(-1.0, 1.0);
    const double z = rng.uniform(-1.0, 1.0);
    const Vector3d point(x, y, z);
    if (point.squaredNorm() <= 1.0) return point;
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

void add_leaves(Mesh& mesh, const Vector3d& centre, const Vector3d& radii, int count,
                double leaf_size_m, Rng& rng) {
  for (int i = 0; i < count; ++i) {
    const Vector3d in_ball = draw_in_ball(rng);
    // Division by the square root of the radius moves leaves outwards.
    const Vector3d middle = centre + radii.cwiseProduct(in_ball / std::sqrt(in_ball.norm() + 1e-9));
    std::array<std::uint32_t, 3> corner{};
    for (std::uint32_t& index : corner) {
      index = mesh.add_vertex(middle + 0.5 * leaf_size_m * draw_in_ball(rng));
    }
    mesh.add_triangle(corner[0], corner[1], corner[2], Material::leaf);
  }
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

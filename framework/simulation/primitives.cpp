#include "framework/simulation/primitives.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// Uniform in the cube of edge 2 around zero, drawn again until it lies in the unit ball.
Vector3d draw_in_ball(Rng& rng) {
  for (;;) {
    const double x = rng.uniform(-1.0, 1.0);
    const double y = rng.uniform(-1.0, 1.0);
    const double z = rng.uniform(-1.0, 1.0);
    const Vector3d point(x, y, z);
    if (point.squaredNorm() <= 1.0) return point;
  }
}

/// A fan over the closed ring of `count` vertices from `first`, around their middle.
void add_fan(Mesh& mesh, std::uint32_t first, std::uint32_t count, Material material) {
  Vector3d middle = Vector3d::Zero();
  for (std::uint32_t i = 0; i < count; ++i) middle += mesh.vertices[first + i].cast<double>();
  const std::uint32_t hub = mesh.add_vertex(middle / count);
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.add_triangle(hub, first + i, first + (i + 1) % count, material);
  }
}

/// The band between two closed rings of `count` vertices each.
void add_band(Mesh& mesh, std::uint32_t first, std::uint32_t second, std::uint32_t count,
              Material material) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.add_quad(first + i, first + next, second + next, second + i, material);
  }
}

}  // namespace

void add_box(Mesh& mesh, const Vector3d& low, const Vector3d& high, Material material) {
  const std::vector<Eigen::Vector2d> profile = {
      {low.x(), low.z()}, {high.x(), low.z()}, {high.x(), high.z()}, {low.x(), high.z()}};
  std::array<std::uint32_t, 8> corner{};
  for (std::size_t i = 0; i < 8; ++i) {
    const Eigen::Vector2d& xz = profile[i % 4];
    corner[i] = mesh.add_vertex({xz.x(), i < 4 ? low.y() : high.y(), xz.y()});
  }
  mesh.add_quad(corner[0], corner[1], corner[2], corner[3], material);
  mesh.add_quad(corner[4], corner[5], corner[6], corner[7], material);
  add_band(mesh, corner[0], corner[4], 4, material);
}

void add_prism(Mesh& mesh, const std::vector<Eigen::Vector2d>& profile, double y0, double y1,
               Material material) {
  const auto count = static_cast<std::uint32_t>(profile.size());
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const double y : {y0, y1}) {
    for (const Eigen::Vector2d& xz : profile) mesh.add_vertex({xz.x(), y, xz.y()});
  }
  add_band(mesh, first, first + count, count, material);
  add_fan(mesh, first, count, material);
  add_fan(mesh, first + count, count, material);
}

void add_cylinder(Mesh& mesh, const Vector3d& from, const Vector3d& to, double from_radius_m,
                  double to_radius_m, int sides, Material material) {
  const Vector3d axis = (to - from).normalized();
  const Vector3d u = axis.unitOrthogonal();
  const Vector3d v = axis.cross(u);
  const auto count = static_cast<std::uint32_t>(sides);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int end = 0; end < 2; ++end) {
    const Vector3d& centre = end == 0 ? from : to;
    const double radius_m = end == 0 ? from_radius_m : to_radius_m;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * kPi * i / sides;
      mesh.add_vertex(centre + radius_m * (std::cos(angle) * u + std::sin(angle) * v));
    }
  }
  add_band(mesh, first, first + count, count, material);
  add_fan(mesh, first, count, material);
  add_fan(mesh, first + count, count, material);
}

void add_ellipsoid(Mesh& mesh, const Vector3d& centre, const Vector3d& radii, int sides,
                   Material material) {
  const auto count = static_cast<std::uint32_t>(sides);
  const int bands = sides / 2;
  std::uint32_t below = 0;
  for (int i = 0; i <= bands; ++i) {
    const double latitude = kPi * (static_cast<double>(i) / bands - 0.5);
    const auto ring = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int j = 0; j < sides; ++j) {
      const double longitude = 2.0 * kPi * j / sides;
      const Vector3d unit(std::cos(latitude) * std::cos(longitude),
                          std::cos(latitude) * std::sin(longitude), std::sin(latitude));
      mesh.add_vertex(centre + radii.cwiseProduct(unit));
    }
    if (i > 0) add_band(mesh, below, ring, count, material);
    below = ring;
  }
}

void add_leaves(Mesh& mesh, const Vector3d& centre, const Vector3d& radii, int count,
                double leaf_size_m, Rng& rng) {
  for (int i = 0; i < count; ++i) {
    const Vector3d in_ball = draw_in_ball(rng);
    // The square root of the radius moves leaves outwards.
    const Vector3d place = centre + radii.cwiseProduct(in_ball / std::sqrt(in_ball.norm() + 1e-9));
    std::array<std::uint32_t, 3> corner{};
    for (std::uint32_t& index : corner) {
      index = mesh.add_vertex(place + 0.5 * leaf_size_m * draw_in_ball(rng));
    }
    mesh.add_triangle(corner[0], corner[1], corner[2], Material::leaf);
  }
}

}  // namespace croon::simulation

#include "framework/simulation/objects/shapes.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// Adds the end over the closed ring of `count` vertices from `first`: triangles around their mean.
void add_fan(Mesh& mesh, std::uint32_t first, std::uint32_t count, Material material) {
  Vector3d middle = Vector3d::Zero();
  for (std::uint32_t i = 0; i < count; ++i) middle += mesh.vertices[first + i].cast<double>();
  const std::uint32_t hub = mesh.add_vertex(middle / count);
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.add_triangle(hub, first + i, first + (i + 1) % count, material);
  }
}

/// The same over a convex ring: triangles around its first vertex.
void add_end(Mesh& mesh, std::uint32_t first, std::uint32_t count, Material material) {
  for (std::uint32_t i = 1; i + 1 < count; ++i) {
    mesh.add_triangle(first, first + i, first + i + 1, material);
  }
}

/// Adds the band between two rings of `count` vertices from `first` and from `second`; between open
/// rings, the quad from the last vertex to the first is omitted.
void add_band(Mesh& mesh, std::uint32_t first, std::uint32_t second, std::uint32_t count,
              Material material, bool is_open = false) {
  for (std::uint32_t i = 0; i + (is_open ? 1 : 0) < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.add_quad(first + i, first + next, second + next, second + i, material);
  }
}

/// Adds the vertices of `rings` and the bands between them.
void add_bands(Mesh& mesh, const std::vector<Ring>& rings, Material material, bool is_open) {
  const auto count = static_cast<std::uint32_t>(rings.front().size());
  const std::uint32_t first = mesh.next_vertex();
  for (const Ring& ring : rings) {
    for (const Vector3d& corner : ring) mesh.add_vertex(corner);
  }
  for (std::uint32_t ring = first; ring + count < mesh.next_vertex(); ring += count) {
    add_band(mesh, ring, ring + count, count, material, is_open);
  }
}

}  // namespace

void add_box(Mesh& mesh, const Vector3d& low, const Vector3d& high, Material material) {
  const std::uint32_t first = mesh.next_vertex();
  for (const double y : {low.y(), high.y()}) {
    mesh.add_vertex({low.x(), y, low.z()});
    mesh.add_vertex({high.x(), y, low.z()});
    mesh.add_vertex({high.x(), y, high.z()});
    mesh.add_vertex({low.x(), y, high.z()});
  }
  add_end(mesh, first, 4, material);
  add_end(mesh, first + 4, 4, material);
  add_band(mesh, first, first + 4, 4, material);
}

void add_cylinder(Mesh& mesh, const Vector3d& from, const Vector3d& to, double from_radius_m,
                  double to_radius_m, int sides, Material material) {
  const Vector3d axis = (to - from).normalized();
  const Vector3d u = axis.unitOrthogonal();
  const Vector3d v = axis.cross(u);
  const auto count = static_cast<std::uint32_t>(sides);
  const auto first = mesh.next_vertex();
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
    const auto ring = mesh.next_vertex();
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

void add_loft(Mesh& mesh, const std::vector<Ring>& rings, Material material) {
  const auto count = static_cast<std::uint32_t>(rings.front().size());
  const std::uint32_t first = mesh.next_vertex();
  add_bands(mesh, rings, material, false);
  add_end(mesh, first, count, material);
  add_end(mesh, mesh.next_vertex() - count, count, material);
}

void add_strip(Mesh& mesh, const std::vector<Ring>& rings, Material material) {
  add_bands(mesh, rings, material, true);
}

}  // namespace croon::simulation

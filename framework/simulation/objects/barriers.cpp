#include "framework/simulation/objects/barriers.hpp"

#include <algorithm>
#include <cmath>

#include "framework/simulation/primitives.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The level direction to the left of the path at its corner `i`.
Vector3d left_of(const Path& path, std::size_t i) {
  const Vector3d& before = path[i > 0 ? i - 1 : i];
  const Vector3d& after = path[std::min(i + 1, path.size() - 1)];
  const Vector3d along = after - before;
  return Vector3d(-along.y(), along.x(), 0.0).normalized();
}

/// Draws the outline `profile` (left of the path, up from it) along `path`, with both ends.
void add_sweep(Mesh& mesh, const Path& path, const std::vector<Vector2d>& profile,
               Material material) {
  const auto count = static_cast<std::uint32_t>(profile.size());
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vector3d left = left_of(path, i);
    for (const Vector2d& corner : profile) {
      mesh.add_vertex(path[i] + corner.x() * left + corner.y() * Vector3d::UnitZ());
    }
  }
  for (std::uint32_t i = 0; i + 1 < path.size(); ++i) {
    for (std::uint32_t j = 0; j < count; ++j) {
      const std::uint32_t here = first + i * count;
      const std::uint32_t next = (j + 1) % count;
      mesh.add_quad(here + j, here + next, here + count + next, here + count + j, material);
    }
  }
  for (const std::uint32_t end :
       {first, first + count * static_cast<std::uint32_t>(path.size() - 1)}) {
    for (std::uint32_t j = 1; j + 1 < count; ++j) {
      mesh.add_triangle(end, end + j, end + j + 1, material);
    }
  }
}

std::vector<Vector2d> rectangle_profile(double half_m, double low_m, double high_m) {
  return {{half_m, low_m}, {half_m, high_m}, {-half_m, high_m}, {-half_m, low_m}};
}

/// Places every `step_m` along the path, from its beginning.
Path places_along(const Path& path, double step_m) {
  Path places;
  double until_next_m = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector3d way = path[i + 1] - path[i];
    const double length_m = way.norm();
    double at_m = until_next_m;
    for (; at_m < length_m; at_m += step_m) places.push_back(path[i] + (at_m / length_m) * way);
    until_next_m = at_m - length_m;
  }
  return places;
}

void add_post(Mesh& mesh, const Vector3d& foot, double radius_m, double height_m,
              Material material) {
  add_cylinder(mesh, foot - Vector3d(0.0, 0.0, 0.3), foot + Vector3d(0.0, 0.0, height_m), radius_m,
               radius_m, 6, material);
}

}  // namespace

Mesh make_wall(const Path& path, double height_m, double thickness_m, Material material) {
  Mesh mesh;
  add_sweep(mesh, path, rectangle_profile(0.5 * thickness_m, -0.3, height_m), material);
  return mesh;
}

Mesh make_garden_wall(const Path& path, double height_m, Rng& rng) {
  const Material material = rng.uniform() < 0.5 ? Material::brick : Material::plaster;
  const double pillars_m = rng.uniform(2.5, 4.0);
  Mesh mesh;
  add_sweep(mesh, path, rectangle_profile(0.12, -0.3, height_m - 0.08), material);
  add_sweep(mesh, path, rectangle_profile(0.17, height_m - 0.08, height_m), Material::concrete);
  for (const Vector3d& foot : places_along(path, pillars_m)) {
    add_box(mesh, foot + Vector3d(-0.2, -0.2, -0.3), foot + Vector3d(0.2, 0.2, height_m + 0.15),
            material);
  }
  return mesh;
}

Mesh make_fence(const Path& path, double height_m, Rng& rng) {
  const bool is_metal = rng.uniform() < 0.5;
  const Material material = is_metal ? Material::metal : Material::wood;
  const double gap_m = rng.uniform(0.15, 0.3);
  const double half_bar_m = is_metal ? 0.015 : 0.05;
  Mesh mesh;
  for (const double rail_m : {0.2 * height_m, 0.85 * height_m}) {
    add_sweep(mesh, path, rectangle_profile(0.02, rail_m - 0.03, rail_m + 0.03), material);
  }
  for (const Vector3d& foot : places_along(path, 2.2)) {
    add_post(mesh, foot, 0.04, height_m, material);
  }
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const Vector3d along = (path[i + 1] - path[i]).normalized();
    for (const Vector3d& foot : places_along({path[i], path[i + 1]}, gap_m)) {
      // A bar is flat: a ray sees its width and not its thickness.
      mesh.add_quad(foot - half_bar_m * along + Vector3d(0.0, 0.0, 0.05),
                    foot + half_bar_m * along + Vector3d(0.0, 0.0, 0.05),
                    foot + half_bar_m * along + Vector3d(0.0, 0.0, height_m),
                    foot - half_bar_m * along + Vector3d(0.0, 0.0, height_m), material);
    }
  }
  return mesh;
}

Mesh make_guard_rail(const Path& path, Rng& rng) {
  const double posts_m = rng.uniform() < 0.5 ? 2.0 : 4.0;
  // Half the W beam and back again: two waves, 8 cm deep, 31 cm high, 3 mm thin at the edges.
  const std::vector<Vector2d> beam = {{0.06, 0.44},  {-0.02, 0.50}, {-0.02, 0.54},
                                      {0.06, 0.595}, {-0.02, 0.65}, {-0.02, 0.69},
                                      {0.06, 0.75},  {0.07, 0.75},  {0.07, 0.44}};
  Mesh mesh;
  add_sweep(mesh, path, beam, Material::metal);
  for (const Vector3d& foot : places_along(path, posts_m)) {
    add_post(mesh, foot, 0.06, 0.7, Material::metal);
  }
  return mesh;
}

Mesh make_jersey_barrier(const Path& path) {
  const std::vector<Vector2d> profile = {{0.3, -0.3},   {0.3, 0.08},   {0.17, 0.33}, {0.08, 0.81},
                                         {-0.08, 0.81}, {-0.17, 0.33}, {-0.3, 0.08}, {-0.3, -0.3}};
  Mesh mesh;
  add_sweep(mesh, path, profile, Material::concrete);
  return mesh;
}

}  // namespace croon::simulation

#include "framework/simulation/objects/structures.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSegment_m = 5.0;

/// Evenly spaced places from the stretch's begin to its end.
std::vector<double> stations(const Stretch& stretch) {
  const double length_m = stretch.to_s_m - stretch.from_s_m;
  const int segments = std::max(1, static_cast<int>(std::ceil(length_m / kSegment_m)));
  std::vector<double> places;
  for (int i = 0; i <= segments; ++i) places.push_back(stretch.from_s_m + length_m * i / segments);
  return places;
}

/// A place `d_m` left of the centre line and `above_m` over the road's middle there: structures are
/// level across the road.
Vector3d over_road(const Ground& ground, double s_m, double d_m, double above_m) {
  Vector3d place = ground.point(s_m, d_m);
  place.z() = ground.height_m(s_m, 0.0) + above_m;
  return place;
}

/// Draws the outline `profile` (d, above the road) along the road; closed ones are shut around.
void add_along(Mesh& mesh, const Ground& ground, const std::vector<double>& places,
               const std::vector<Vector2d>& profile, bool is_closed, Material material) {
  const auto count = static_cast<std::uint32_t>(profile.size());
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const double s_m : places) {
    for (const Vector2d& corner : profile) {
      mesh.add_vertex(over_road(ground, s_m, corner.x(), corner.y()));
    }
  }
  const std::uint32_t sides = is_closed ? count : count - 1;
  for (std::uint32_t i = 0; i + 1 < places.size(); ++i) {
    for (std::uint32_t j = 0; j < sides; ++j) {
      const std::uint32_t here = first + i * count;
      const std::uint32_t next = (j + 1) % count;
      mesh.add_quad(here + j, here + next, here + count + next, here + count + j, material);
    }
  }
}

/// A closed profile with both ends shut.
void add_beam(Mesh& mesh, const Ground& ground, const std::vector<double>& places,
              const std::vector<Vector2d>& profile, Material material) {
  add_along(mesh, ground, places, profile, true, material);
  for (const double s_m : {places.front(), places.back()}) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vector2d& corner : profile) {
      mesh.add_vertex(over_road(ground, s_m, corner.x(), corner.y()));
    }
    for (std::uint32_t j = 1; j + 1 < profile.size(); ++j) {
      mesh.add_triangle(first, first + j, first + j + 1, material);
    }
  }
}

std::vector<Vector2d> box_profile(double left_m, double right_m, double low_m, double high_m) {
  return {{left_m, low_m}, {left_m, high_m}, {right_m, high_m}, {right_m, low_m}};
}

/// The inside of a tunnel from foot to foot.
std::vector<Vector2d> lining(double half_width_m, double height_m, bool is_arched) {
  constexpr double kFoot_m = -0.5;
  if (!is_arched) {
    return {{half_width_m, kFoot_m},
            {half_width_m, height_m},
            {-half_width_m, height_m},
            {-half_width_m, kFoot_m}};
  }
  constexpr int kSides = 12;
  constexpr double kSpring_m = 2.6;  // Where the arch begins.
  std::vector<Vector2d> profile = {{half_width_m, kFoot_m}};
  for (int i = 0; i <= kSides; ++i) {
    const double angle = kPi * i / kSides;
    profile.push_back(
        {half_width_m * std::cos(angle), kSpring_m + (height_m - kSpring_m) * std::sin(angle)});
  }
  profile.push_back({-half_width_m, kFoot_m});
  return profile;
}

/// Everything between the tunnel's opening and a rectangle around it.
void add_portal(Mesh& mesh, const Ground& ground, double s_m, const std::vector<Vector2d>& opening,
                double half_width_m, double height_m) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vector2d& corner : opening) {
    // The same corner pushed out to the rectangle.
    const double side = corner.x() >= 0.0 ? 1.0 : -1.0;
    const bool is_foot = &corner == &opening.front() || &corner == &opening.back();
    mesh.add_vertex(over_road(ground, s_m, corner.x(), corner.y()));
    mesh.add_vertex(over_road(ground, s_m, is_foot ? side * half_width_m : corner.x() * 1.3,
                              is_foot ? corner.y() : height_m));
  }
  for (std::uint32_t i = 0; i + 1 < opening.size(); ++i) {
    const std::uint32_t at = first + 2 * i;
    mesh.add_quad(at, at + 1, at + 3, at + 2, Material::concrete);
  }
}

}  // namespace

Mesh make_tunnel(const Ground& ground, const Stretch& stretch, Rng& rng) {
  const RoadShape& shape = ground.shape();
  const double kerbside_m = rng.uniform(0.8, 1.6);
  const double height_m = rng.uniform(5.2, 6.5);
  const bool is_arched = rng.uniform() < 0.5;
  const double ribs_m = rng.uniform() < 0.5 ? rng.uniform(8.0, 15.0) : 0.0;
  const double half_width_m = shape.half_width_m + kerbside_m;
  // An arch must be high enough at the kerb for a lorry.
  const std::vector<Vector2d> profile =
      lining(half_width_m, is_arched ? height_m + 1.5 : height_m, is_arched);
  const std::vector<double> places = stations(stretch);
  Mesh mesh;
  add_along(mesh, ground, places, profile, false, Material::concrete);
  for (const double s_m : {stretch.from_s_m, stretch.to_s_m}) {
    add_portal(mesh, ground, s_m, profile, half_width_m * 1.6, height_m + 3.0);
  }
  for (const double side : {-1.0, 1.0}) {
    const double wall_m = side * half_width_m;
    for (double s_m = stretch.from_s_m + 3.0; s_m + 1.0 < stretch.to_s_m; s_m += 10.0) {
      add_beam(mesh, ground, {s_m, s_m + 1.2}, box_profile(wall_m, wall_m - side * 0.25, 4.6, 4.8),
               Material::glass);
    }
    if (ribs_m <= 0.0) continue;
    for (double s_m = stretch.from_s_m; s_m + 0.4 < stretch.to_s_m; s_m += ribs_m) {
      add_beam(mesh, ground, {s_m, s_m + 0.4}, box_profile(wall_m, wall_m - side * 0.3, -0.5, 4.0),
               Material::concrete);
    }
  }
  return mesh;
}

Mesh make_bridge(const Ground& ground, const Stretch& stretch, Rng& rng) {
  const RoadShape& shape = ground.shape();
  const double clear_m = rng.uniform(4.9, 5.6);
  const double deck_m = rng.uniform(0.8, 1.2);
  const double beside_m = shape.half_width_m + std::max(shape.pavement_width_m, 1.0);
  const double half_width_m = beside_m + rng.uniform(3.0, 10.0);
  const bool has_piers = half_width_m - beside_m > 6.0;
  const std::vector<double> places = stations(stretch);
  Mesh mesh;
  add_beam(mesh, ground, places,
           box_profile(-half_width_m, half_width_m, clear_m, clear_m + deck_m), Material::concrete);
  const double edge_m[2] = {stretch.from_s_m, stretch.to_s_m - 0.25};
  for (const double s_m : edge_m) {
    add_beam(mesh, ground, {s_m, s_m + 0.25},
             box_profile(-half_width_m, half_width_m, clear_m + deck_m, clear_m + deck_m + 1.0),
             Material::concrete);
  }
  for (const double side : {-1.0, 1.0}) {
    const double abutment_m = has_piers ? half_width_m - 0.8 : beside_m + 0.2;
    add_beam(mesh, ground, places,
             box_profile(side * abutment_m, side * (abutment_m + 0.8), -1.0, clear_m),
             Material::concrete);
    if (!has_piers) continue;
    for (double s_m = stretch.from_s_m + 1.0; s_m + 0.8 < stretch.to_s_m; s_m += 5.0) {
      add_beam(mesh, ground, {s_m, s_m + 0.8},
               box_profile(side * (beside_m + 0.2), side * (beside_m + 1.0), -1.0, clear_m),
               Material::concrete);
    }
  }
  return mesh;
}

}  // namespace croon::simulation

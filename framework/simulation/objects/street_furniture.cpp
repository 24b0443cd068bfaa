#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// Adds a bin on two wheels with a lid.
void add_wheeled_bin(Mesh& mesh, Rng& rng) {
  const double height_m = rng.uniform(0.95, 1.3);
  const double half_m = rng.uniform(0.23, 0.55);
  const double depth_m = rng.uniform(0.28, 0.4);
  const double rim_m = height_m - 0.1;
  add_stack(
      mesh,
      {{0.06, -0.8 * depth_m, 0.75 * depth_m, 0.8 * half_m}, {rim_m, -depth_m, depth_m, half_m}},
      Material::rubber);
  add_box(mesh, {0.3 * depth_m, -0.7 * half_m, 0.0}, {0.6 * depth_m, 0.7 * half_m, 0.06},
          Material::rubber);
  add_stack(mesh,
            {{rim_m, -depth_m - 0.05, depth_m + 0.03, half_m + 0.03},
             {rim_m + 0.04, -depth_m - 0.05, depth_m + 0.03, half_m + 0.03},
             {height_m, -depth_m, 0.6 * depth_m, 0.8 * half_m}},
            Material::paint);
  for (const double side : {-1.0, 1.0}) {
    const Vector3d hub(-0.8 * depth_m, side * 0.8 * half_m, 0.1);
    add_cylinder(mesh, hub, hub + Vector3d(0.0, side * 0.06, 0.0), 0.1, 0.1, 8, Material::rubber);
  }
}

/// Adds a round litter bin on a post.
void add_litter_bin(Mesh& mesh, Rng& rng) {
  const double height_m = rng.uniform(0.9, 1.15);
  const double radius_m = rng.uniform(0.18, 0.25);
  const Vector3d foot(radius_m, 0.0, height_m - 0.6);
  const Vector3d rim(radius_m, 0.0, height_m - 0.08);
  add_cylinder(mesh, {0.0, 0.0, 0.0}, {0.0, 0.0, height_m - 0.05}, 0.035, 0.035, 8,
               Material::metal);
  add_cylinder(mesh, foot, rim, 0.85 * radius_m, radius_m, 12, Material::metal);
  add_cylinder(mesh, rim, rim + Vector3d(0.0, 0.0, 0.08), radius_m + 0.02, 0.7 * radius_m, 12,
               Material::metal);
}

/// Adds a seat with legs, `half_m` to both sides, from `back_m` 0.4 m forward.
void add_seat(Mesh& mesh, double back_m, double half_m, double seat_m) {
  for (int i = 0; i < 3; ++i) {
    const double x = back_m + 0.14 * i;
    add_box(mesh, {x, -half_m, seat_m - 0.04}, {x + 0.12, half_m, seat_m}, Material::wood);
  }
  for (const double y : {-0.8 * half_m, 0.8 * half_m}) {
    add_box(mesh, {back_m + 0.02, y - 0.03, 0.0}, {back_m + 0.38, y + 0.03, seat_m - 0.04},
            Material::metal);
  }
}

}  // namespace

Mesh make_bin(Rng& rng) {
  Mesh mesh;
  if (chance(rng, 0.5)) {
    add_wheeled_bin(mesh, rng);
  } else {
    add_litter_bin(mesh, rng);
  }
  return mesh;
}

Mesh make_bench(Rng& rng) {
  Mesh mesh;
  const double half_m = rng.uniform(0.75, 1.0);
  const double seat_m = rng.uniform(0.42, 0.48);
  const bool has_back = chance(rng, 0.75);
  add_seat(mesh, -0.2, half_m, seat_m);
  if (!has_back) return mesh;
  for (const double z_m : {seat_m + 0.12, seat_m + 0.28}) {
    add_box(mesh, {-0.26, -half_m, z_m}, {-0.22, half_m, z_m + 0.12}, Material::wood);
  }
  for (const double y : {-0.8 * half_m, 0.8 * half_m}) {
    add_box(mesh, {-0.3, y - 0.03, seat_m - 0.1}, {-0.26, y + 0.03, seat_m + 0.42},
            Material::metal);
    add_box(mesh, {-0.3, y - 0.03, seat_m - 0.1}, {-0.18, y + 0.03, seat_m - 0.04},
            Material::metal);
  }
  return mesh;
}

Mesh make_bus_stop(Rng& rng) {
  Mesh mesh;
  const double half_m = rng.uniform(1.4, 2.2);
  const double depth_m = rng.uniform(1.2, 1.6);
  const double roof_m = rng.uniform(2.3, 2.6);
  const bool has_poster = chance(rng, 0.5);
  const double back_m = -0.5 * depth_m;
  const double end_m = 0.25 * depth_m;  // The ends are shorter than the roof.
  for (const double x : {back_m, end_m}) {
    for (const double y : {-half_m, half_m}) {
      add_box(mesh, {x - 0.04, y - 0.04, 0.0}, {x + 0.04, y + 0.04, roof_m}, Material::metal);
    }
  }
  add_stack(mesh,
            {{roof_m, back_m - 0.1, 0.5 * depth_m, half_m + 0.12},
             {roof_m + 0.08, back_m - 0.1, 0.5 * depth_m, half_m + 0.12},
             {roof_m + 0.13, back_m + 0.1, 0.5 * depth_m - 0.2, half_m - 0.1}},
            Material::metal);
  add_box(mesh, {back_m - 0.006, -half_m, 0.12}, {back_m + 0.006, half_m, roof_m - 0.1},
          Material::glass);
  for (const double y : {-half_m, half_m}) {
    const Material pane = has_poster && y > 0.0 ? Material::sign : Material::glass;
    add_box(mesh, {back_m, y - 0.006, 0.12}, {end_m, y + 0.006, roof_m - 0.1}, pane);
  }
  add_seat(mesh, back_m + 0.15, 0.6 * half_m, 0.46);
  return mesh;
}

}  // namespace croon::simulation

#include <algorithm>

#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The outline (y, z) about 0 of a round, triangular or rectangular plate.
std::vector<Vector2d> draw_plate(Rng& rng) {
  const auto shape = rng.below(3);
  const double size_m = rng.uniform(0.6, 0.9);
  const double height_ratio = rng.uniform(0.5, 1.5);
  if (shape == 0) return regular_polygon(0.5 * size_m, 16);
  if (shape == 1) return regular_polygon(0.58 * size_m, 3);
  return rectangle(size_m, height_ratio * size_m);
}

/// The height of the part of an outline that is below 0.
double depth_below(const std::vector<Vector2d>& outline) {
  double depth_m = 0.0;
  for (const Vector2d& yz : outline) depth_m = std::max(depth_m, -yz.y());
  return depth_m;
}

/// Adds three lamps under visors around `middle`.
void add_lamp_head(Mesh& mesh, const Vector3d& middle, double size_m) {
  const Vector3d half(0.1, 0.55 * size_m, 1.65 * size_m);
  add_box(mesh, middle - half, middle + half, Material::rubber);
  for (const double row : {-1.0, 0.0, 1.0}) {
    const Vector3d lamp = middle + Vector3d(half.x(), 0.0, row * size_m);
    add_cylinder(mesh, lamp, lamp + Vector3d(0.03, 0.0, 0.0), 0.42 * size_m, 0.36 * size_m, 10,
                 Material::glass);
    const double top_m = lamp.z() + 0.45 * size_m;
    add_box(mesh, {lamp.x(), -0.45 * size_m, top_m},
            {lamp.x() + 0.7 * size_m, 0.45 * size_m, top_m + 0.02}, Material::rubber);
  }
}

}  // namespace

Mesh make_lamp(Rng& rng) {
  Mesh mesh;
  const double height_m = rng.uniform(5.0, 9.0);
  const double arm_m = rng.uniform(0.6, 1.8);
  const double rise_m = rng.uniform(0.05, 0.25) * arm_m;
  const double head_m = rng.uniform(0.5, 0.8);
  const double radius_m = 0.045 + 0.006 * height_m;
  const Vector3d top(0.0, 0.0, height_m - rise_m - 0.1);
  const Vector3d end = top + Vector3d(arm_m, 0.0, rise_m);
  add_cylinder(mesh, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.1}, 1.5 * radius_m, 1.5 * radius_m, 10,
               Material::metal);
  add_cylinder(mesh, {0.0, 0.0, 1.1}, top, radius_m, 0.6 * radius_m, 10, Material::metal);
  add_cylinder(mesh, top, end, 0.55 * radius_m, 0.4 * radius_m, 6, Material::metal);
  const double front_m = end.x() + head_m;
  add_stack(mesh,
            {{end.z() - 0.06, end.x() - 0.1, front_m, 0.15},
             {end.z() + 0.02, end.x() - 0.1, front_m, 0.15},
             {end.z() + 0.1, end.x(), front_m - 0.15, 0.07}},
            Material::metal);
  add_box(mesh, {end.x() + 0.05, -0.11, end.z() - 0.09}, {front_m - 0.05, 0.11, end.z() - 0.06},
          Material::glass);
  return mesh;
}

Mesh make_traffic_light(Rng& rng) {
  Mesh mesh;
  const double size_m = rng.uniform(0.24, 0.32);  // Distance from one lamp to the next.
  const double foot_m = rng.uniform(2.1, 2.6);
  const double middle_m = foot_m + 1.65 * size_m;
  const bool has_board = chance(rng, 0.4);
  const bool has_button = chance(rng, 0.6);
  add_cylinder(mesh, {0.0, 0.0, 0.0}, {0.0, 0.0, middle_m + 1.8 * size_m}, 0.06, 0.05, 10,
               Material::metal);
  add_lamp_head(mesh, {0.17, 0.0, middle_m}, size_m);
  if (has_board) {
    add_plate(mesh, {0.09, 0.0, middle_m}, rectangle(2.0 * size_m, 4.2 * size_m), 0.02,
              Material::rubber);
  }
  if (has_button) add_box(mesh, {0.04, -0.05, 0.95}, {0.13, 0.05, 1.2}, Material::sign);
  return mesh;
}

Mesh make_sign(Rng& rng) {
  Mesh mesh;
  const double radius_m = rng.uniform(0.03, 0.04);
  const double clear_m = rng.uniform(1.5, 2.4);
  double z_m = clear_m;
  const int plates = draw_int(rng, 1, 2);
  for (int i = 0; i < plates; ++i) {
    const std::vector<Vector2d> outline = draw_plate(rng);
    const double half_m = depth_below(outline);
    add_plate(mesh, {radius_m + 0.02, 0.0, z_m + half_m}, outline, 0.012, Material::sign);
    // A plate extends as far above its middle as below it, a triangle twice as far.
    z_m += half_m + (outline.size() == 3 ? 2.0 : 1.0) * half_m + 0.03;
  }
  add_cylinder(mesh, {0.0, 0.0, 0.0}, {0.0, 0.0, z_m}, radius_m, radius_m, 8, Material::metal);
  return mesh;
}

Mesh make_bollard(Rng& rng) {
  Mesh mesh;
  const double height_m = rng.uniform(0.7, 1.1);
  const double radius_m = rng.uniform(0.05, 0.11);
  const Material material =
      pick<Material>({Material::metal, Material::concrete, Material::rubber}, rng);
  const Vector3d shoulder(0.0, 0.0, 0.9 * height_m);
  add_cylinder(mesh, Vector3d::Zero(), shoulder, radius_m, radius_m, 12, material);
  add_cylinder(mesh, shoulder, {0.0, 0.0, height_m}, radius_m, 0.5 * radius_m, 12, material);
  add_cylinder(mesh, 0.75 * shoulder, 0.88 * shoulder, radius_m + 0.004, radius_m + 0.004, 12,
               Material::sign);
  return mesh;
}

}  // namespace croon::simulation

#include <algorithm>

#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kClear_m = 5.2;

/// Adds two chords across the road, from `-half_m` to `half_m` in y, and the lacing between them.
void add_truss(Mesh& mesh, double half_m, double low_m, double depth_m) {
  for (const double z_m : {low_m, low_m + depth_m}) {
    add_box(mesh, {-0.09, -half_m, z_m - 0.09}, {0.09, half_m, z_m + 0.09}, Material::metal);
  }
  const int bays = std::max(2, static_cast<int>(2.0 * half_m / 1.5));
  for (int i = 0; i < bays; ++i) {
    const double from_m = -half_m + 2.0 * half_m * i / bays;
    const double to_m = -half_m + 2.0 * half_m * (i + 1) / bays;
    const double rise_m = i % 2 == 0 ? depth_m : 0.0;
    add_cylinder(mesh, {0.0, from_m, low_m + depth_m - rise_m}, {0.0, to_m, low_m + rise_m}, 0.04,
                 0.04, 5, Material::metal);
  }
}

}  // namespace

Mesh make_gantry(double width_m, Rng& rng) {
  Mesh mesh;
  const double column_m = 0.5 * width_m + rng.uniform(0.6, 1.0);
  const double depth_m = rng.uniform(0.8, 1.2);
  const double low_m = rng.uniform(kClear_m + 0.5, kClear_m + 0.9);
  const int signs = std::max(1, static_cast<int>(width_m / 4.0));
  for (const double y : {-column_m, column_m}) {
    add_cylinder(mesh, {0.0, y, 0.0}, {0.0, y, low_m + depth_m + 0.3}, 0.2, 0.16, 12,
                 Material::metal);
    add_box(mesh, {-0.35, y - 0.35, 0.0}, {0.35, y + 0.35, 0.25}, Material::concrete);
  }
  add_truss(mesh, column_m, low_m, depth_m);
  for (int i = 0; i < signs; ++i) {
    const double lane_m = width_m / signs;
    const double plate_m = rng.uniform(0.55, 0.9) * lane_m;
    const double height_m = rng.uniform(1.2, 2.4);
    const double bottom_m = rng.uniform(kClear_m, kClear_m + 0.3);
    const Vector3d middle(0.15, -0.5 * width_m + (i + 0.5) * lane_m, bottom_m + 0.5 * height_m);
    add_plate(mesh, middle, rectangle(plate_m, height_m), 0.05, Material::sign);
  }
  return mesh;
}

}  // namespace croon::simulation

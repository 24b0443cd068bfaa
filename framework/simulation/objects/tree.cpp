#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// A rounded part of a crown.
struct Clump {
  Vector3d centre = Vector3d::Zero();
  Vector3d radii = Vector3d::Ones();
};

/// Adds `leaves` leaves, and a few larger sprays that make the middle of the clump dense.
void add_clump(Mesh& mesh, const Clump& clump, int leaves, double leaf_size_m, Rng& rng) {
  constexpr int kSprays = 40;
  const double spray_m = std::min(1.1, clump.radii.minCoeff());
  add_leaves(mesh, clump.centre, 0.5 * clump.radii, kSprays, spray_m, rng);
  // Leaves extend half their size beyond their centres.
  const Vector3d radii = (clump.radii.array() - 0.5 * leaf_size_m).matrix();
  add_leaves(mesh, clump.centre, radii, leaves, leaf_size_m, rng);
}

/// Adds a trunk of `height_m` that leans a little, and returns its top.
Vector3d add_trunk(Mesh& mesh, double height_m, double radius_m, Rng& rng) {
  const double lean_x = rng.uniform(-0.06, 0.06);
  const double lean_y = rng.uniform(-0.06, 0.06);
  const int sides = draw_int(rng, 8, 12);
  const double taper_ratio = rng.uniform(0.45, 0.65);
  const Vector3d flare(0.0, 0.0, 0.25);
  const Vector3d top(lean_x * height_m, lean_y * height_m, height_m);
  add_cylinder(mesh, Vector3d::Zero(), flare, 1.35 * radius_m, radius_m, sides, Material::bark);
  add_cylinder(mesh, flare, top, radius_m, taper_ratio * radius_m, sides, Material::bark);
  return top;
}

/// Adds a trunk with boughs that end in clumps, around a clump in the middle.
void add_broad_crown(Mesh& mesh, double height_m, Rng& rng) {
  const double radius_m = (0.012 + rng.uniform(0.004, 0.01)) * height_m + 0.04;
  const Vector3d fork = add_trunk(mesh, rng.uniform(0.28, 0.4) * height_m, radius_m, rng);
  const double spread_m = rng.uniform(0.14, 0.2) * height_m;
  const double leaf_size_m = rng.uniform(0.36, 0.45);
  const double rise_m = height_m - fork.z();
  const Vector3d top_radii(1.1 * spread_m, 1.1 * spread_m, 0.33 * rise_m);
  const Vector3d summit = fork + Vector3d(0.0, 0.0, rise_m - top_radii.z());
  add_cylinder(mesh, fork, summit, 0.5 * radius_m, 0.2 * radius_m, 5, Material::bark);
  const int boughs = draw_int(rng, 4, 5);
  const int leaves = 420 / (boughs + 1);
  add_clump(mesh, {summit, top_radii}, leaves, leaf_size_m, rng);
  const double turn_rad = rng.uniform(0.0, 2.0 * kPi);
  for (int i = 0; i < boughs; ++i) {
    const double angle_rad = turn_rad + 2.0 * kPi * i / boughs + rng.uniform(-0.3, 0.3);
    const double out_m = rng.uniform(0.8, 1.2) * spread_m;
    const double up_m = rng.uniform(0.2, 0.5) * rise_m;
    const Vector3d end =
        fork + Vector3d(out_m * std::cos(angle_rad), out_m * std::sin(angle_rad), up_m);
    const double size_m = rng.uniform(0.75, 1.05) * spread_m;
    add_cylinder(mesh, fork, end, 0.45 * radius_m, 0.2 * radius_m, 5, Material::bark);
    add_clump(mesh, {end, {size_m, size_m, std::min(0.9 * size_m, 0.25 * rise_m)}}, leaves,
              leaf_size_m, rng);
  }
}

/// Adds a trunk with whorls of boughs that become shorter towards the tip.
void add_conifer(Mesh& mesh, double height_m, Rng& rng) {
  const double trunk_radius_m = 0.012 * height_m + 0.05;
  const Vector3d top = add_trunk(mesh, 0.9 * height_m, trunk_radius_m, rng);
  const double base_ratio = rng.uniform(0.08, 0.2);
  const double spread_m = rng.uniform(0.16, 0.22) * height_m;
  const double leaf_size_m = rng.uniform(0.36, 0.45);
  constexpr int kWhorls = 6;
  for (int i = 0; i < kWhorls; ++i) {
    const double ratio = base_ratio + (0.95 - base_ratio) * i / kWhorls;
    const double step_m = (0.95 - base_ratio) * height_m / kWhorls;
    const double radius_m = spread_m * (1.02 - ratio);
    const Vector3d foot(ratio * top.x(), ratio * top.y(), ratio * height_m);
    const Vector3d tip = foot + Vector3d(0.0, 0.0, 1.3 * step_m);
    const Vector3d end(tip.x(), tip.y(), std::min(tip.z(), height_m));
    add_cylinder(mesh, foot, end, 0.55 * radius_m, 0.1 * radius_m, 8, Material::leaf);
    const Vector3d radii(radius_m, radius_m, 0.45 * step_m);
    const int leaves = static_cast<int>(160.0 * (1.05 - ratio));
    add_leaves(mesh, foot + Vector3d(0.0, 0.0, 0.5 * step_m), radii, leaves, leaf_size_m, rng);
  }
}

/// Adds a slim column of leaves that begins close to the ground.
void add_poplar(Mesh& mesh, double height_m, Rng& rng) {
  const Vector3d top = add_trunk(mesh, 0.6 * height_m, 0.01 * height_m + 0.06, rng);
  const double radius_m = rng.uniform(0.1, 0.14) * height_m;
  const double leaf_size_m = rng.uniform(0.3, 0.4);
  constexpr int kClumps = 4;
  for (int i = 0; i < kClumps; ++i) {
    const double ratio = (i + 0.5) / kClumps;
    const double girth_m = radius_m * (1.0 - 0.45 * std::abs(2.0 * ratio - 0.8));
    const double foot_m = 0.12 * height_m;
    const double half_m = 0.68 * (height_m - foot_m) / kClumps;
    const double z_m = std::min(foot_m + ratio * (height_m - foot_m), height_m - half_m);
    const Vector3d centre(ratio * top.x(), ratio * top.y(), std::max(z_m, half_m + 0.2));
    add_clump(mesh, {centre, {girth_m, girth_m, half_m}}, 130, leaf_size_m, rng);
  }
}

}  // namespace

Mesh make_tree(Rng& rng) {
  Mesh mesh;
  const double height_m = rng.uniform(4.2, 12.0);
  const double share = rng.uniform();
  if (share < 0.7) {
    add_broad_crown(mesh, height_m, rng);
  } else if (share < 0.87) {
    add_conifer(mesh, height_m, rng);
  } else {
    add_poplar(mesh, height_m, rng);
  }
  return mesh;
}

}  // namespace croon::simulation

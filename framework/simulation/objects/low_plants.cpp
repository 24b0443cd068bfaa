#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// The outline across the core of a hedge at `x`. Each corner is moved by up to `rough_m`.
Ring hedge_section(double x, double half_width_m, double height_m, double rough_m, Rng& rng) {
  const std::vector<Eigen::Vector2d> outline = {
      {-0.85 * half_width_m, 0.0},      {-half_width_m, 0.6 * height_m},
      {-0.75 * half_width_m, height_m}, {0.75 * half_width_m, height_m},
      {half_width_m, 0.6 * height_m},   {0.85 * half_width_m, 0.0}};
  Ring ring;
  for (const Eigen::Vector2d& yz : outline) {
    const double y = yz.x() + rng.uniform(-rough_m, rough_m);
    const double z = yz.y() == 0.0 ? 0.0 : yz.y() + rng.uniform(-rough_m, rough_m);
    ring.emplace_back(x, y, z);
  }
  return ring;
}

/// Adds one bent blade of grass.
void add_blade(Mesh& mesh, const Vector3d& foot, double height_m, Rng& rng) {
  const double angle_rad = rng.uniform(0.0, 2.0 * kPi);
  const double bend_rad = rng.uniform(0.0, 2.0 * kPi);
  const double bend_m = rng.uniform(0.05, 0.4) * height_m;
  const Vector3d half_width =
      rng.uniform(0.015, 0.035) * Vector3d(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  const Vector3d tip(bend_m * std::cos(bend_rad), bend_m * std::sin(bend_rad), height_m);
  const std::uint32_t first = mesh.add_vertex(foot - half_width);
  mesh.add_vertex(foot + half_width);
  mesh.add_vertex(foot + tip);
  mesh.add_triangle(first, first + 1, first + 2, Material::grass);
}

}  // namespace

Mesh make_bush(Rng& rng) {
  Mesh mesh;
  const double height_m = rng.uniform(0.6, 1.8);
  const double girth_ratio = rng.uniform(0.4, 0.65);
  const double leaf_size_m = 0.12 + 0.08 * height_m;
  const Vector3d centre(0.0, 0.0, 0.5 * height_m);
  const Vector3d radii(girth_ratio * height_m, girth_ratio * height_m, 0.5 * height_m);
  // A solid core on a stem.
  add_ellipsoid(mesh, centre, 0.62 * radii, 8, Material::leaf);
  add_cylinder(mesh, Vector3d::Zero(), centre, 0.05, 0.04, 5, Material::bark);
  const Vector3d reach = (radii.array() - 0.5 * leaf_size_m).matrix();
  add_leaves(mesh, centre, reach, 110, leaf_size_m, rng);
  return mesh;
}

Mesh make_hedge(double length_m, double height_m, double width_m, Rng& rng) {
  Mesh mesh;
  const double leaf_size_m = std::min(0.3, 0.4 * std::min(width_m, height_m));
  const double depth_m = 0.5 * leaf_size_m;  // Protrusion of leaves from the core.
  const double half_m = 0.5 * width_m - depth_m;
  const double top_m = height_m - depth_m;
  const int pieces = std::max(1, static_cast<int>(length_m));
  const double piece_m = length_m / pieces;
  std::vector<Ring> sections;
  for (int i = 0; i <= pieces; ++i) {
    sections.push_back(hedge_section(i * piece_m, half_m, top_m, 0.5 * depth_m, rng));
  }
  add_loft(mesh, sections, Material::leaf);
  const double along_m = 0.5 * piece_m - depth_m;
  const double up_m = 0.5 * height_m - depth_m;
  for (int i = 0; i < pieces; ++i) {
    const double x = (i + 0.5) * piece_m;
    for (const double y : {-half_m - 0.3 * depth_m, half_m + 0.3 * depth_m}) {
      add_leaves(mesh, {x, y, 0.5 * height_m}, {along_m, 0.02, up_m}, 8, leaf_size_m, rng);
    }
    add_leaves(mesh, {x, 0.0, top_m}, {along_m, 0.8 * half_m, 0.02}, 6, leaf_size_m, rng);
  }
  return mesh;
}

Mesh make_tufts(double length_m, double width_m, Rng& rng) {
  Mesh mesh;
  constexpr int kBlades = 9;
  const int tufts = static_cast<int>(std::ceil(4.0 * length_m));
  for (int i = 0; i < tufts; ++i) {
    const double x = rng.uniform(0.0, length_m);
    const double y = rng.uniform(-0.5, 0.5) * width_m;
    const double height_m = rng.uniform(0.2, 0.7);
    for (int blade = 0; blade < kBlades; ++blade) {
      const double off_x = rng.uniform(-0.1, 0.1);
      const double off_y = rng.uniform(-0.1, 0.1);
      const double blade_m = rng.uniform(0.6, 1.0) * height_m;
      add_blade(mesh, {x + off_x, y + off_y, 0.0}, blade_m, rng);
    }
  }
  return mesh;
}

}  // namespace croon::simulation

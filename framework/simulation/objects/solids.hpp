#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// The corners of a convex outline, metres, in order around it.
using Ring = std::vector<Eigen::Vector3d>;

/// The skin from each of `rings` to the next, with both ends shut; all have as many corners.
void add_loft(Mesh& mesh, const std::vector<Ring>& rings, Material material);

/// A plate of `thickness_m` that looks along x: `outline` (y, z) about `front`, the middle of its
/// front.
void add_plate(Mesh& mesh, const Eigen::Vector3d& front,
               const std::vector<Eigen::Vector2d>& outline, double thickness_m, Material material);

/// The corners (y, z) of a rectangle about 0.
std::vector<Eigen::Vector2d> rectangle(double width_m, double height_m);

/// The corners (y, z) of a regular polygon about 0, one of them at the top.
std::vector<Eigen::Vector2d> regular_polygon(double radius_m, int corners);

/// A level rectangle, about 0 in y.
struct Level {
  double z_m = 0.0;
  double rear_m = 0.0;   ///< x of its rear edge.
  double front_m = 0.0;  ///< x of its front edge.
  double half_width_m = 0.0;
};

/// The level at `ratio` of the way from `low` (0) to `high` (1).
Level between(const Level& low, const Level& high, double ratio);

/// The solid from each level up to the next.
void add_stack(Mesh& mesh, const std::vector<Level>& levels, Material material);

/// From one number to another: a stretch along x, a range to draw from.
struct Span {
  double from = 0.0;
  double to = 0.0;
};

/// The stretches of `whole` that are in none of `holes`, which are in order and apart.
std::vector<Span> without(const Span& whole, const std::vector<Span>& holes);

}  // namespace croon::simulation

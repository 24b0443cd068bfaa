#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/simulation/draws.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// Adds the box between the corners `low` and `high`.
void add_box(Mesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
             Material material);

/// Adds a closed cylinder or cone frustum with `sides` flat sides, from `from` (radius
/// `from_radius_m`) to `to`.
void add_cylinder(Mesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                  double from_radius_m, double to_radius_m, int sides, Material material);

/// Adds an ellipsoid with the half axes `radii`, of `sides` meridians and half as many parallels.
void add_ellipsoid(Mesh& mesh, const Eigen::Vector3d& centre, const Eigen::Vector3d& radii,
                   int sides, Material material);

/// Adds leaves: `count` triangles of `leaf_size_m` with random positions in an ellipsoid and random
/// orientations. They are denser towards the outside, as in the crown of a tree.
void add_leaves(Mesh& mesh, const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, int count,
                double leaf_size_m, Rng& rng);

/// The corners of an outline in order around it, metres.
using Ring = std::vector<Eigen::Vector3d>;

/// Adds the surface from each of `rings` to the next, and both ends. The rings are convex and have
/// the same number of corners.
void add_loft(Mesh& mesh, const std::vector<Ring>& rings, Material material);

/// Adds the surface from each of `rings` to the next without the ends. The rings are open: their
/// last corners are not joined to the first ones.
void add_strip(Mesh& mesh, const std::vector<Ring>& rings, Material material);

/// Adds a plate of `thickness_m` that faces x. Its outline (y, z) is relative to `front`, the
/// middle of its front.
void add_plate(Mesh& mesh, const Eigen::Vector3d& front,
               const std::vector<Eigen::Vector2d>& outline, double thickness_m, Material material);

/// The corners (y, z) of a rectangle about 0.
std::vector<Eigen::Vector2d> rectangle(double width_m, double height_m);

/// The corners (y, z) of a regular polygon about 0, with one at the top.
std::vector<Eigen::Vector2d> regular_polygon(double radius_m, int corners);

/// A level rectangle, symmetric about y = 0.
struct Level {
  double z_m = 0.0;
  double rear_m = 0.0;   ///< x of its rear edge.
  double front_m = 0.0;  ///< x of its front edge.
  double half_width_m = 0.0;
};

/// The level at `ratio` of the way from `low` (0) to `high` (1).
Level between(const Level& low, const Level& high, double ratio);

/// Adds the solid that joins each level to the next.
void add_stack(Mesh& mesh, const std::vector<Level>& levels, Material material);

/// The parts of `whole` outside of `holes`, which are in ascending order and do not overlap.
std::vector<Span> without(const Span& whole, const std::vector<Span>& holes);

}  // namespace croon::simulation

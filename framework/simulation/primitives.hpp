#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// The six sides of the box between the corners `low` and `high`.
void add_box(Mesh& mesh, const Eigen::Vector3d& low, const Eigen::Vector3d& high,
             Material material);

/// The outline `profile` (x, z), whose every corner is seen from its middle, drawn out from `y0` to
/// `y1`, with both ends.
void add_prism(Mesh& mesh, const std::vector<Eigen::Vector2d>& profile, double y0, double y1,
               Material material);

/// A cylinder, or a cone frustum, from `from` (radius `from_radius_m`) to `to`, of `sides` flat
/// sides, with both ends.
void add_cylinder(Mesh& mesh, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                  double from_radius_m, double to_radius_m, int sides, Material material);

/// An ellipsoid with half axes `radii`, of `sides` meridians and half as many parallels.
void add_ellipsoid(Mesh& mesh, const Eigen::Vector3d& centre, const Eigen::Vector3d& radii,
                   int sides, Material material);

/// `count` triangles of `leaf_size_m`, anywhere in an ellipsoid and turned anyhow: leaves, which
/// rays pass between. Denser towards the outside, as crowns are.
void add_leaves(Mesh& mesh, const Eigen::Vector3d& centre, const Eigen::Vector3d& radii, int count,
                double leaf_size_m, Rng& rng);

}  // namespace croon::simulation

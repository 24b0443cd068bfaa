#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/simulation/objects/barriers.hpp"
#include "framework/simulation/objects/solids.hpp"

namespace croon::simulation {

/// An outline that is drawn along a line: to the left of it and up from it, metres.
using Profile = std::vector<Eigen::Vector2d>;

/// The outline of a box between two corners.
Profile box_profile(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// `profile` across `path` at each of its corners, mitred, so that what is drawn through the rings
/// is as thick in each piece.
std::vector<Ring> rings_along(const Path& path, const Profile& profile);

/// The skin from each of `rings` to the next, open at both ends and along its edges.
void add_strip(Mesh& mesh, const std::vector<Ring>& rings, Material material);

/// A place on a path and the level direction of the path there, of length 1.
struct PathPlace {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
};

/// Places along the path from its begin to its end, evenly spaced, `step_m` or less apart.
std::vector<PathPlace> places_along(const Path& path, double step_m);

/// An upright box about `place`, from `low_m` to `high_m` above it; `half_m` along and across.
void add_pillar(Mesh& mesh, const PathPlace& place, const Eigen::Vector2d& half_m, double low_m,
                double high_m, Material material);

}  // namespace croon::simulation

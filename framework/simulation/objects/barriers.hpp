#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// A line on the ground, in world coordinates, that a barrier follows; two places or more, no two
/// neighbours alike.
using Path = std::vector<Eigen::Vector3d>;

/// A smooth wall of `height_m` and `thickness_m`, about the path. Goes 0.3 m below it.
Mesh make_wall(const Path& path, double height_m, double thickness_m, Material material);

/// A wall with pillars and a coping; the pillars are `height_m` high.
Mesh make_garden_wall(const Path& path, double height_m, Rng& rng);

/// Posts and thin bars or boards, which rays pass between.
Mesh make_fence(const Path& path, double height_m, Rng& rng);

/// A W-beam on either side of posts, 0.75 m high.
Mesh make_guard_rail(const Path& path, Rng& rng);

/// A concrete barrier with the profile of a Jersey barrier, 0.8 m high.
Mesh make_jersey_barrier(const Path& path);

}  // namespace croon::simulation

#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>

#include "framework/spatial/leaf_grid.hpp"

namespace croon {

/// The number of directions that direction_bin tells apart.
inline constexpr int kDirectionBins = 75;

/// The bin of a surface's direction, about 20 degrees wide, the same for the opposite normal.
int direction_bin(const Eigen::Vector3d& normal);

/// How many there are of each direction, by its bin.
using DirectionCounts = std::array<int, kDirectionBins>;

/// The weights n^-`exponent` of directions of which there are n each; 0 of those without any.
std::array<double, kDirectionBins> direction_weights(const DirectionCounts& counts,
                                                     double exponent);

/// A cube and the bin of a direction: what shares them is taken for one surface, whose errors are
/// not independent.
using SurfaceKey = std::pair<LeafKey, int>;

/// The surface of a point with a normal, in cubes of edge `cube_m`. Points farther off than cubes
/// can be counted are in the last one.
SurfaceKey surface_key(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double cube_m);

}  // namespace croon

#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>

#include "framework/spatial/leaf_grid.hpp"

namespace croon {

/// The number of bins of direction_bin.
inline constexpr int kDirectionBins = 75;

/// The bin of a surface's direction, about 20 degrees wide, the same for the opposite normal.
int direction_bin(const Eigen::Vector3d& normal);

/// The number of elements of each direction, by bin.
using DirectionCounts = std::array<int, kDirectionBins>;

/// The weights n^-`exponent` for directions with n elements each; 0 for those without any.
std::array<double, kDirectionBins> direction_weights(const DirectionCounts& counts,
                                                     double exponent);

/// A cube and the bin of a direction: elements that share them count as one surface, whose errors
/// are not independent.
using SurfaceKey = std::pair<LeafKey, int>;

/// The surface of a point with a normal, in cubes of edge `cube_m`. Points beyond the range of cube
/// indices belong to the last cube.
SurfaceKey surface_key(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double cube_m);

}  // namespace croon

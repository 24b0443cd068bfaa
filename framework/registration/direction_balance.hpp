#pragma once

#include "framework/registration/icp_loop.hpp"

namespace croon {

/// The number of directions that direction_bin tells apart.
inline constexpr int kDirectionBins = 75;

/// The bin of a surface's direction, about 20 degrees wide, the same for the opposite normal.
int direction_bin(const Eigen::Vector3d& normal);

/// Weighs each correspondence by n^-`exponent` for n correspondences whose target normals have
/// about its direction, times a constant by which the mean weight is 1. Without it a street's
/// ground and fronts outvote the few surfaces that hold the pose along the street.
SelectCorrespondences balanced_directions(double exponent);

}  // namespace croon

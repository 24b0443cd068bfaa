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

/// The weights n^-`exponent` of the points `indices` of `cloud`, where n of these points are in one
/// cube of edge `patch_m` and have normals of about one direction. Points without a normal must not
/// be among them.
std::vector<double> patch_weights(const Cloud& cloud, const std::vector<int>& indices,
                                  int normal_neighbours, double patch_m, double exponent);

}  // namespace croon

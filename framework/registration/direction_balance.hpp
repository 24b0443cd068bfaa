#pragma once

#include "framework/registration/icp_loop.hpp"

namespace croon {

/// Weighs each correspondence by n^-`exponent` for n correspondences whose target normals have
/// about its direction, times a constant by which the mean weight is 1. Without it a street's
/// ground and fronts outvote the few surfaces that hold the pose along the street.
SelectCorrespondences balanced_directions(double exponent);

/// Which patch of surface each of the points `indices` of `cloud` is on, numbered from 0 in their
/// order: those in one cube of edge `patch_m` whose normals have about one direction. Points
/// without a normal must not be among them.
std::vector<int> patches_of(const Cloud& cloud, const std::vector<int>& indices,
                            int normal_neighbours, double patch_m);

/// The weights n^-`exponent` of points, n of which are on one patch.
std::vector<double> patch_weights(const std::vector<int>& patches, double exponent);

}  // namespace croon

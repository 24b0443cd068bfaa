#pragma once

#include "framework/registration/icp_loop.hpp"

namespace croon {

/// Weights each correspondence by n^-`exponent` for n correspondences whose target normals have
/// about the same direction, scaled to a mean weight of 1. Without it, a street's ground and
/// facades outvote the few surfaces that constrain the pose along the street.
SelectCorrespondences balanced_directions(double exponent);

/// The index of the surface patch of each of the points `indices` of `cloud`, numbered from 0 in
/// order of appearance: points in one cube of edge `patch_m` whose normals have about the same
/// direction share a patch. All points must have a normal.
std::vector<int> patches_of(const Cloud& cloud, const std::vector<int>& indices,
                            int normal_neighbours, double patch_m);

/// The weights n^-`exponent` of points, for n points on the same patch.
std::vector<double> patch_weights(const std::vector<int>& patches, double exponent);

}  // namespace croon

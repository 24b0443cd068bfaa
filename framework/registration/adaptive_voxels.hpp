#pragma once

#include <vector>

#include "framework/params/table.hpp"
#include "framework/registration/plane_cost.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// How planes are found in the points of all sensors together.
struct VoxelOptions {
  std::vector<double> voxels_m = {1.0, 0.25};  ///< The edges of the largest and the smallest.
  double max_thickness_ratio = 0.1;
  int min_points = 10;
  int min_sensor_points = 3;
  double surface_error_m = 0.003;  ///< What a surface is off a plane, however many points it has.
};

/// The rows of VoxelOptions.
const params::Table<VoxelOptions>& voxel_table();

/// One cloud of a scene and whose it is.
struct SensorCloud {
  std::size_t sensor = 0;
  const Cloud* cloud = nullptr;
  /// When its points were measured, seconds, around zero; empty if no motion is of interest.
  std::vector<double> times_s = {};
};

/// The pieces of planes that at least two of the clouds of one scene see in the `state` of the rig,
/// by adaptive voxels (MLCC: Liu, Yuan and Zhang, T-IM 2022): a cube of edge
/// `voxels_m.front()` whose points are no plane is cut into eight, down to `voxels_m.back()`.
/// Points are on a plane if the least eigenvalue of their covariance is at most
/// `max_thickness_ratio` of the middle one. Of each cloud every `stride`-th point takes part.
///
/// Two grids, shifted by a third of an edge, are searched: a plane that a face of its cube may have
/// cut along its surface is not taken, because what is cut off depends on the poses; it is inside
/// of a cube of the other grid. Most planes are in both.
///
/// The sums are of the points as they are at the velocity of `state`; where times are given, the
/// views have the sums by which a further velocity moves them.
///
/// The points of a view weigh together `1 / (s^2 / n + e^2)` for n points with the variance s^2
/// off the plane, of all sensors together and at least (5 mm)^2, and the error e of the surface, so
/// that the cost is in units of its own noise, and a wall with a thousand points does not outvote
/// ten with a hundred. Among them a point counts as often as its channel `mean_of` says. A voxel
/// filter cuts a noisy wall along the borders of its leaves: if each leaf counted once, the few
/// points beyond a border would count as much as the many before it, and the wall would move
/// towards the border.
std::vector<PlanePatch> plane_patches(const std::vector<SensorCloud>& clouds, const RigState& state,
                                      int stride, const VoxelOptions& options);

}  // namespace croon

#pragma once

#include <vector>

#include "framework/params/table.hpp"
#include "framework/registration/plane_cost.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// The parameters of the search for planes in the points of all sensors.
struct VoxelOptions {
  std::vector<double> voxels_m = {1.0, 0.25};  ///< The maximum and the minimum edge.
  double max_thickness_ratio = 0.1;
  int min_points = 10;
  int min_sensor_points = 3;
  double surface_std_m = 0.003;  ///< Deviation of a surface from a plane, for any number of points.
};

/// The rows of VoxelOptions.
const params::Table<VoxelOptions>& voxel_table();

/// One cloud of a scene and its sensor.
struct SensorCloud {
  std::size_t sensor = 0;
  const Cloud* cloud = nullptr;
  /// The measurement times of its points, seconds, around zero; empty if motion is ignored.
  std::vector<double> times_s = {};
};

/// The pieces of planes that at least two clouds of one scene see in the `state` of the rig, by
/// adaptive voxels (MLCC: Liu, Yuan and Zhang, T-IM 2022): a cube of edge `voxels_m.front()` whose
/// points do not form a plane is divided into eight, down to `voxels_m.back()`. Points form a plane
/// if the minimum eigenvalue of their covariance is at most `max_thickness_ratio` times the middle
/// one. Uses every `stride`-th point of each cloud.
///
/// Two grids, shifted by a third of an edge, are searched. A plane so close to a face of its cube
/// that the face may cut off some of its points is discarded, because which points are cut off
/// depends on the poses; in the other grid, the plane lies inside a cube. Most planes are found in
/// both.
///
/// The sums are over the points as they are at the velocity of `state`; if times are given, the
/// views also contain the sums that account for a further velocity.
///
/// The points of a view have the total weight `1 / (s^2 / n + e^2)` for n points with the variance
/// s^2 across the plane, computed over all sensors and at least (5 mm)^2, and the error e of the
/// surface. So the cost is in units of its own noise, and a wall with a thousand points does not
/// outvote ten with a hundred. Within a view, a point counts as many times as its channel `mean_of`
/// specifies. A voxel filter cuts a noisy wall along the borders of its leaves: if each leaf
/// counted once, the few points beyond a border would count as much as the many before it, and the
/// wall would shift towards the border.
std::vector<PlanePatch> plane_patches(const std::vector<SensorCloud>& clouds, const RigState& state,
                                      int stride, const VoxelOptions& options);

}  // namespace croon

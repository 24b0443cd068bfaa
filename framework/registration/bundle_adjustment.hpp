#pragma once

#include <vector>

#include "framework/geometry/pose_covariance.hpp"
#include "framework/params/table.hpp"
#include "framework/registration/adaptive_voxels.hpp"

namespace croon {

/// The parameters of `adjust_bundle`.
struct BundleOptions {
  std::vector<double> voxels_m = {2.0, 0.5};
  double max_thickness_ratio = 0.0625;
  int min_points = 15;
  int min_sensor_points = 5;
  double surface_error_m = 0.003;
  double kernel_width = 3.0;
  std::vector<double> start_std = {1.0, 0.2};
  int coarse_stride = 4;
  int coarse_passes = 3;
  int max_passes = 8;
  int max_iterations = 20;
  int min_planes = 30;
  double covariance_scale = 1.25;
};

/// The rows of BundleOptions.
const params::Table<BundleOptions>& bundle_table();

/// The clouds of one scene, each cloud of one moment.
using BundleScene = std::vector<SensorCloud>;

/// The result of a bundle adjustment.
struct Bundle {
  std::vector<RigidTransform> poses;  ///< By sensor; the first is the common frame and stays.
  std::vector<int> planes;            ///< By sensor: how many planes it shares with another one.
  /// By sensor, see adjust_bundle; zero for the first and for those that took no part.
  std::vector<PoseCovariance> covariances;
  double cost_per_plane = 0.0;  ///< In units of the planes' noise, see plane_patches.
  int passes = 0;
  int iterations = 0;
  bool converged = false;
};

/// Moves the sensors of a rig so that what they see in all scenes lies on planes: least squares of
/// the distances of all points to planes that are unknown too, eliminated in closed form (see
/// PlaneCost), with the kernel of Geman and McClure on the cost of each plane, by Newton's method
/// with the damping of Levenberg and Marquardt. Each pass looks for planes at the present poses
/// and sums their points once; after that an iteration costs nothing per point. All sensors that
/// see a plane hold each other, not only those that share it with the first. Coarse passes take a
/// part of the points. A sensor with less than `min_planes` keeps its pose and takes no part.
///
/// Covariances are those of the M-estimator with dependent errors (the sandwich of Huber 1967 over
/// clusters, Liang and Zeger 1986): `H^-1 (sum of g_c g_c^T) H^-1` with the gradient g_c of the
/// planes c of one scene, one direction and one cube of 8 m, whose errors are not independent. A
/// degree of freedom is weak if its standard deviation is more than a tenth of what was expected of
/// the start, and unobservable if it is more than a half.
///
/// `start` is by sensor, the first of them the identity.
Bundle adjust_bundle(const std::vector<BundleScene>& scenes,
                     const std::vector<RigidTransform>& start, const BundleOptions& options);

}  // namespace croon

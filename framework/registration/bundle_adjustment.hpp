#pragma once

#include <array>
#include <optional>
#include <vector>

#include "framework/geometry/pose_covariance.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/params/table.hpp"
#include "framework/registration/adaptive_voxels.hpp"

namespace croon {

/// The parameters of `adjust_bundle`.
struct BundleOptions : VoxelOptions {
  BundleOptions();

  double kernel_width = 5.0;
  std::vector<double> prior_std = {1.0, 0.2};
  double prior_weight = 0.25;
  int coarse_stride = 4;
  int coarse_passes = 3;
  int max_passes = 8;
  int max_iterations = 20;
  int min_planes = 6;
  double std_scale = 1.15;
  double velocity_error_std_mps = 0.08;
  double clock_offset_std_s = 0.0;
};

/// The rows of BundleOptions.
const params::Table<BundleOptions>& bundle_table();

/// The clouds of one scene, each corrected to one moment.
struct BundleScene {
  std::vector<SensorCloud> clouds;
  /// Of the common frame during the scans; the clouds were corrected for it.
  Twist velocity;
  /// The covariance of that velocity: about its axes in rad/s, along them in m/s. If it is not
  /// zero, all clouds need times, with a common zero.
  Matrix6d motion_covariance = Matrix6d::Zero();
};

/// The result of a bundle adjustment.
struct Bundle {
  std::vector<RigidTransform> poses;  ///< By sensor; the first is the fixed common frame.
  /// By scene: the estimated correction of its velocity; std::nullopt if the velocity is certain.
  std::vector<std::optional<Twist>> velocities;
  std::vector<int> planes;  ///< By sensor: number of planes that it shares with others.
  /// By sensor, see adjust_bundle; zero for the first and for those that were excluded.
  std::vector<PoseCovariance> covariances;
  /// By sensor: the observability of each degree of freedom from its planes alone, see
  /// plane_observability.
  std::vector<DofObservability> plane_observability;
  /// By sensor: the offset to be added to its times to obtain those of the first, and its standard
  /// deviation. Zero unless they are unknowns.
  std::vector<double> clock_offsets_s;
  std::vector<double> clock_offset_stds_s;
  /// The cost, including the priors, divided by the number of planes, in units of their noise.
  double cost_per_plane = 0.0;
  int passes = 0;
  int iterations = 0;
  bool converged = false;
};

/// Moves the sensors of a rig so that their points in all scenes lie on planes: least squares of
/// the distances of all points to planes, which are unknown too and eliminated in closed form (see
/// PlaneCost), with the Geman-McClure kernel on the cost of each plane, by Newton's method with
/// Levenberg-Marquardt damping. Each pass finds planes at the current poses and sums their points
/// once; after that the cost of an iteration does not depend on the number of points. All sensors
/// that see a plane constrain each other, not only those that share it with the first. The velocity
/// of a scene is an unknown as well if it is uncertain, with its covariance as the prior. Coarse
/// passes use a subset of the points. A sensor with fewer than `min_planes` keeps its pose and is
/// excluded: the result for the others is as if it did not exist.
///
/// If BundleOptions::clock_offset_std_s is above zero, the offset of each sensor's clock to the
/// first's is an unknown, the same in all scenes: in a scene with the velocity xi, the pose of a
/// sensor whose times must be increased by d is `exp(xi d) T`. Only scenes with different
/// velocities distinguish it from a translation.
///
/// The prior of the initial poses is an observation like a plane, weighted by `prior_weight`: a
/// registration also uses surfaces that are not planes, and its error is nearly independent of that
/// of the planes.
///
/// Covariances are estimated from clusters c, the planes of one scene, one direction and one cube
/// of 3 m, whose errors are not independent: see covariance_by_clusters. Poses and velocities are
/// eliminated from each other, and the priors of initial poses and velocities contribute with their
/// own covariance and their weight. In a scene with an uncertain velocity, the change of the poses
/// for an error of `velocity_error_std_mps` along the velocity is added: a moving object is
/// elsewhere when the next sensor sees it, which leaving out one surface at a time does not reveal.
/// According to its covariance, a degree of freedom is weak if its standard deviation exceeds a
/// tenth of `prior_std`, and unobservable if it exceeds a half; see plane_observability for the
/// planes.
///
/// `start` contains, by sensor, T_common_sensor and its information in addition to
/// BundleOptions::prior_std; the first is the identity.
Bundle adjust_bundle(const std::vector<BundleScene>& scenes, const std::vector<InformedPose>& start,
                     const BundleOptions& options);

}  // namespace croon

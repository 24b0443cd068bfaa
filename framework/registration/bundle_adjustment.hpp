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
  std::vector<double> start_std = {1.0, 0.2};
  double start_weight = 0.25;
  int coarse_stride = 4;
  int coarse_passes = 3;
  int max_passes = 8;
  int max_iterations = 20;
  int min_planes = 6;
  double covariance_scale = 1.15;
  double velocity_error_mps = 0.08;
  double clock_offset_std_s = 0.0;
};

/// The rows of BundleOptions.
const params::Table<BundleOptions>& bundle_table();

/// The clouds of one scene, each corrected to be of one moment.
struct BundleScene {
  std::vector<SensorCloud> clouds;
  /// Of the common frame during the scans, by which the clouds were corrected.
  Twist velocity;
  /// Of what is not known of that velocity: about its axes in rad/s, along them in m/s. If it is
  /// not zero, all clouds need their times, with a common zero.
  Matrix6d motion_covariance = Matrix6d::Zero();
};

/// The result of a bundle adjustment.
struct Bundle {
  std::vector<RigidTransform> poses;  ///< By sensor; the first is the common frame and stays.
  /// By scene: what was added to the velocity by which it was corrected; none where that is
  /// certain.
  std::vector<std::optional<Twist>> velocities;
  std::vector<int> planes;  ///< By sensor: how many planes it shares with another one.
  /// By sensor, see adjust_bundle; zero for the first and for those that took no part.
  std::vector<PoseCovariance> covariances;
  /// By sensor: how well its planes alone hold each degree of freedom, see plane_words.
  std::vector<DofWords> plane_words;
  /// By sensor: added to its times, they are those of the first; and the standard deviation of
  /// that. Zero unless they are unknowns.
  std::vector<double> clock_offsets_s;
  std::vector<double> clock_offset_stds_s;
  /// The cost over the planes, with that of what was known before, in units of the planes' noise.
  double cost_per_plane = 0.0;
  int passes = 0;
  int iterations = 0;
  bool converged = false;
};

/// Moves the sensors of a rig so that what they see in all scenes lies on planes: least squares of
/// the distances of all points to planes that are unknown too, eliminated in closed form (see
/// PlaneCost), with the kernel of Geman and McClure on the cost of each plane, by Newton's method
/// with the damping of Levenberg and Marquardt. Each pass looks for planes at the present poses
/// and sums their points once; after that an iteration costs nothing per point. All sensors that
/// see a plane hold each other, not only those that share it with the first. The velocity of a
/// scene that is not certain is an unknown as well, expected to differ by its covariance. Coarse
/// passes take a part of the points. A sensor with less than `min_planes` keeps its pose and takes
/// no part: the others are where they would be without it.
///
/// If BundleOptions::clock_offset_std_s is above zero, the offset of each sensor's clock to the
/// first's is an unknown, the same in all scenes: in a scene with the velocity xi a sensor whose
/// times lack d stands at `exp(xi d) T`. Only scenes of different velocities tell it from a shift.
///
/// What is known of the starts is an observation like a plane, weighed with `start_weight`: a
/// registration sees what is no plane, and its error is nearly independent of that of the planes.
///
/// Covariances are by clusters c, the planes of one scene, one direction and one cube of 3 m, whose
/// errors are not independent: see covariance_by_clusters.
/// Poses and velocities are eliminated from each other, and what is known of starts and velocities
/// adds its own, with the covariance that it has and the weight that it got. In a scene that moves
/// with a velocity that is not certain, what the poses would move if the velocity were off by
/// `velocity_error_mps` along itself is added: what drives by itself is elsewhere when the next
/// sensor sees it, which leaving out one surface at a time does not show. By its covariance a
/// degree of freedom is weak if its standard deviation is more than a tenth of `start_std`, and
/// unobservable if it is more than a half; by its planes as plane_words says.
///
/// `start` is by sensor, T_common_sensor and what is known of it beside BundleOptions::start_std;
/// the first of them is the identity.
Bundle adjust_bundle(const std::vector<BundleScene>& scenes, const std::vector<InformedPose>& start,
                     const BundleOptions& options);

}  // namespace croon

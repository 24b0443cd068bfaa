#pragma once

#include <optional>
#include <vector>

#include "framework/registration/bundle_adjustment.hpp"
#include "framework/registration/plane_cost.hpp"

namespace croon {

/// The unknowns of a bundle adjustment.
struct BundleState {
  std::vector<RigidTransform> poses;  ///< T_common_sensor, by sensor.
  /// By scene: the change of the velocity relative to the one for which its clouds were corrected;
  /// std::nullopt if the latter is certain.
  std::vector<std::optional<Twist>> velocities;
  /// By sensor: the offset to be added to its times to obtain those of the first.
  std::vector<double> clock_offsets_s;
};

/// The second-order terms of a cost with respect to the free poses of the sensors, 6 for each, and
/// the offsets of their clocks, if those are unknowns, with each scene's velocity eliminated (Schur
/// complement): for any step of the poses, the velocity takes the step that is then optimal.
struct ReducedCost {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  /// The step of the velocity: `rest + by_pose * step of the others`; empty without a velocity.
  Eigen::MatrixXd by_pose;
  Eigen::VectorXd rest;
};

/// The cost of a bundle of planes that adjust_bundle minimises.
class BundleSystem {
 public:
  BundleSystem(const std::vector<BundleScene>& scenes, const std::vector<InformedPose>& start,
               const BundleOptions& options);

  const BundleState& state() const { return state_; }
  void set_state(BundleState state) { state_ = std::move(state); }

  /// Finds the planes of all scenes at the current state, from every `stride`-th point. A sensor
  /// that shares fewer than BundleOptions::min_planes of them with other active sensors is
  /// excluded: it returns to its initial pose, and no plane contains its points.
  void find_planes(int stride);
  /// By scene.
  const std::vector<std::vector<PlanePatch>>& planes() const { return planes_; }
  std::size_t number_of_planes() const;
  /// By sensor: the number of planes that it shares with others; for an excluded sensor, the number
  /// that led to its exclusion.
  const std::vector<int>& planes_of_sensors() const { return planes_of_sensors_; }
  /// The sensors that share enough planes to be moved; never the first.
  const std::vector<std::size_t>& free_sensors() const { return free_sensors_; }

  /// The value in another state, with the current planes.
  double value_in(const BundleState& state) const;
  /// The positions of a sensor's pose and of the offset of its clock among the unknowns that all
  /// scenes share; constant unless it is free.
  const Block& pose_block(std::size_t sensor) const { return pose_blocks_[sensor]; }
  const Block& clock_block(std::size_t sensor) const { return clock_blocks_[sensor]; }
  /// The cost of some planes of a scene and, if `with_prior`, of the prior of its velocity, with
  /// respect to the shared unknowns and then to the velocity.
  BlockSystem scene_cost(std::size_t scene, const std::vector<PlanePatch>& planes,
                         bool with_prior) const;
  /// The covariance of the gradient of the prior of a scene's velocity, as in start_scatter.
  Matrix6d velocity_scatter(std::size_t scene) const {
    return 4.0 * options_.prior_weight * velocity_information_[scene];
  }
  /// The cost of the priors of initial poses and clocks, with respect to the shared unknowns.
  BlockSystem start_cost() const;
  /// The covariance of the gradient of start_cost. The cost weakens the prior of the initial poses
  /// (BundleOptions::prior_weight), but the covariance of their errors is unchanged.
  Eigen::MatrixXd start_scatter() const;
  /// The information of the prior of a sensor's initial pose.
  Matrix6d start_information(std::size_t sensor) const;
  /// The standard deviations of BundleOptions::prior_std, in the order of Dof.
  const Vector6d& prior_std() const { return prior_std_; }

  /// The velocity for which the clouds of a scene were corrected.
  const Twist& known_velocity(std::size_t scene) const { return scenes_[scene].velocity; }

  /// The rig in `state`, as needed by planes() of a scene: its velocity is relative to that at
  /// which they were found.
  RigState rig_state(const BundleState& state, std::size_t scene) const;

 private:
  bool has_offsets() const { return options_.clock_offset_std_s > 0.0; }
  /// The velocity of the rig in a scene.
  Twist velocity_in_scene(const BundleState& state, std::size_t scene) const;
  /// The poses of the sensors in a scene: their clock offsets move them along its velocity.
  std::vector<RigidTransform> poses_in(const BundleState& state, std::size_t scene) const;
  /// Converts the cost of a scene from the poses of its sensors in it to the unknowns.
  BlockSystem with_offsets(const BlockSystem& cost, std::size_t scene) const;
  double start_value(const BundleState& state) const;
  std::vector<int> counted_planes() const;
  /// Finds the planes that the first sensor and the free ones share at the current state.
  void search_planes(int stride);

  const std::vector<BundleScene>& scenes_;
  const std::vector<InformedPose>& start_;
  const BundleOptions& options_;
  Vector6d prior_std_;
  std::vector<Matrix6d> velocity_information_;  ///< By scene.
  BundleState state_;
  std::vector<std::vector<PlanePatch>> planes_;
  std::vector<std::optional<Twist>> planes_velocities_;  ///< Those at which the planes were found.
  std::vector<std::size_t> free_sensors_;
  std::vector<Block> pose_blocks_, clock_blocks_;  ///< By sensor.
  Eigen::Index unknowns_ = 0;                      ///< Number of unknowns that all scenes share.
  std::vector<int> planes_of_sensors_;
};

/// Eliminates the velocity, the last six of the unknowns of `cost`, if `has_velocity`.
ReducedCost reduced(const BlockSystem& cost, bool has_velocity);

}  // namespace croon

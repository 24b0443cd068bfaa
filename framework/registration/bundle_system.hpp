#pragma once

#include <optional>
#include <vector>

#include "framework/registration/bundle_adjustment.hpp"
#include "framework/registration/bundle_cost.hpp"

namespace croon {

/// The unknowns of a bundle adjustment.
struct BundleState {
  std::vector<RigidTransform> poses;  ///< T_common_sensor, by sensor.
  /// By scene: by how much its velocity differs from that by which its clouds were corrected; none
  /// where that is certain.
  std::vector<std::optional<Twist>> velocities;
  std::vector<double> clock_offsets_s;  ///< By sensor: added to its times, they are the first's.
};

/// The second-order terms of a cost by the free poses of the sensors, 6 for each, and the offsets
/// of their clocks, if those are unknowns, after each scene's velocity was eliminated: for any step
/// of the poses it makes its own best step (the Schur complement).
struct ReducedCost {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
  /// The step of the velocity: `rest + by_pose * step of the others`; of size zero without one.
  Eigen::MatrixXd by_pose;
  Eigen::VectorXd rest;
};

/// The cost of a bundle of planes: what adjust_bundle minimises.
class BundleSystem {
 public:
  BundleSystem(const std::vector<BundleScene>& scenes, const std::vector<InformedPose>& start,
               const BundleOptions& options);

  const BundleState& state() const { return state_; }
  void set_state(BundleState state) { state_ = std::move(state); }

  /// Finds the planes of all scenes at the present state, of every `stride`-th point. A sensor that
  /// shares less than BundleOptions::min_planes of them with others that take part takes no part:
  /// it goes back to its start, and no plane has what it sees.
  void find_planes(int stride);
  /// By scene.
  const std::vector<std::vector<PlanePatch>>& planes() const { return planes_; }
  std::size_t number_of_planes() const;
  /// By sensor: how many planes it shares with others; of one that takes no part, those for which
  /// it was left out.
  const std::vector<int>& planes_of_sensors() const { return planes_of_sensors_; }
  /// The sensors that share enough planes to be moved; never the first.
  const std::vector<std::size_t>& free_sensors() const { return free_sensors_; }

  /// The value in another state, by the present planes.
  double value_in(const BundleState& state) const;
  /// The cost of some planes of a scene and, if `with_prior`, of what is known of its velocity, by
  /// the free poses, then by the offsets of their clocks, one for each, if those are unknowns, and
  /// then by the velocity.
  BundleCost scene_cost(std::size_t scene, const std::vector<PlanePatch>& planes,
                        bool with_prior) const;
  /// The covariance of the gradient of the cost of what is known of the velocity of a scene, as
  /// start_scatter.
  Matrix6d velocity_scatter(std::size_t scene) const {
    return 4.0 * options_.start_weight * velocity_information_[scene];
  }
  /// The cost of what is known of the starts and of clocks, by the free poses and the offsets.
  BundleCost start_cost() const;
  /// The covariance of the gradient of start_cost. In the cost what is known of the starts counts
  /// as if it was less certain (BundleOptions::start_weight); its errors are what they are.
  Eigen::MatrixXd start_scatter() const;
  /// What is known of the start of a sensor, the inverse of its covariance.
  Matrix6d start_information(std::size_t sensor) const;
  /// The standard deviations of BundleOptions::start_std, in the order of Dof.
  const Vector6d& start_std() const { return start_std_; }

  /// The velocity by which the clouds of a scene were corrected.
  const Twist& known_velocity(std::size_t scene) const { return scenes_[scene].velocity; }

  /// The rig in `state` as planes() of a scene see it: its velocity is relative to that at which
  /// they were found.
  RigState rig_state(const BundleState& state, std::size_t scene) const;

 private:
  bool has_offsets() const { return options_.clock_offset_std_s > 0.0; }
  /// The velocity of the rig in a scene.
  Twist velocity_in_scene(const BundleState& state, std::size_t scene) const;
  /// Where the sensors stand in a scene: their clocks move them along its velocity.
  std::vector<RigidTransform> poses_in(const BundleState& state, std::size_t scene) const;
  /// The cost of a scene, which is by where its sensors stand in it, by the unknowns.
  BundleCost with_offsets(const BundleCost& cost, std::size_t scene) const;
  double start_value(const BundleState& state) const;
  std::vector<int> counted_planes() const;
  /// The planes that the first sensor and the free ones share at the present state.
  void search_planes(int stride);

  const std::vector<BundleScene>& scenes_;
  const std::vector<InformedPose>& start_;
  const BundleOptions& options_;
  Vector6d start_std_;
  std::vector<Matrix6d> velocity_information_;  ///< By scene.
  BundleState state_;
  std::vector<std::vector<PlanePatch>> planes_;
  std::vector<std::optional<Twist>> planes_velocities_;  ///< At which the planes were found.
  std::vector<std::size_t> free_sensors_;
  std::vector<int> planes_of_sensors_;
};

/// Eliminates the velocity, the last six of the unknowns of `cost`, if `has_velocity`.
ReducedCost reduced(const BundleCost& cost, bool has_velocity);

}  // namespace croon

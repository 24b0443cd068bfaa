#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/registration/joint_pair.hpp"

namespace croon {

/// When a scene is stationary, and when its velocity is certain.
struct MotionOptions {
  double min_motion = 100.0;
  double max_speed_std_mps = 0.05;
  std::vector<double> other_speeds_mps = {-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0};
  double min_speed_lead = 1.5;
  double certain_shift_m = 0.0025;
};

/// The rows of MotionOptions.
const params::Table<MotionOptions>& motion_table();

/// The standard deviation of the velocity along x and y of the target, from the velocity's
/// covariance (about the axes in rad/s, along them in m/s).
double speed_std_mps(const Matrix6d& covariance);

/// For each source of the scene, the standard deviation, in m, of its translation that is due to
/// the `covariance` of that velocity. A sensor that sees the same surfaces as the target at the
/// same time hardly moves.
std::vector<double> shift_std_m(const DeskewedTarget& target, const Matrix6d& covariance,
                                const JointState& state, const JointOptions& options);

/// The estimated motion of a scene.
struct SceneMotion {
  Twist velocity;  ///< Of the target, in its own frame; zero if the scene is stationary.
  Matrix6d covariance = Matrix6d::Zero();  ///< About the axes in rad/s, along them in m/s.
  bool is_moving = false;
  /// By source, if the speed is uncertain: the lead, in standard deviations, of the agreement over
  /// other speeds, see leads_over_rivals. std::nullopt if no other speed moves the source.
  std::vector<std::optional<double>> leads;
  std::vector<double> shift_std_m;  ///< By source: standard deviation due to the velocity.

  /// Whether the speed must be compared with others.
  bool is_in_doubt(const MotionOptions& options) const;
  /// Why the pose of a source is rejected, in words and numbers; empty if it is accepted.
  std::string rejection(std::size_t source, const MotionOptions& options) const;
};

/// The motion of scene `s` in `state`. Moving objects may decide between two velocities: then the
/// velocity in `state_without_patch_kernel`, the state without the patch kernel, differs, and the
/// difference adds to the uncertainty.
SceneMotion motion_of(const JointScene& scene, std::size_t s, const JointState& state,
                      const std::optional<JointState>& state_without_patch_kernel,
                      const JointOptions& options, const MotionOptions& motion_options);

/// The horizontal axis along which a scene most likely moves: the principal axis of the second
/// moment of its velocity, which has the mean `velocity` and the covariance of `motion`. A unit
/// vector in the direction of the velocity, or else of x.
Eigen::Vector3d axis_of_motion(const SceneMotion& motion, const Twist& velocity);

}  // namespace croon

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/registration/joint_registration.hpp"

namespace croon {

/// When a scene stands still, and when its velocity is certain.
struct MotionOptions {
  double min_motion = 100.0;
  double certain_speed_std_mps = 0.05;
  std::vector<double> other_speeds_mps = {-30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 30.0};
  double min_speed_lead = 1.5;
  double certain_shift_m = 0.0025;
};

/// The rows of MotionOptions.
const params::Table<MotionOptions>& motion_table();

/// The standard deviation of the velocity along x and y of the target, from the velocity's
/// covariance (about the axes in rad/s, along them in m/s).
double speed_std_mps(const Matrix6d& covariance);

/// What is known of the motion of a scene.
struct SceneMotion {
  Twist velocity;  ///< Of the target, in its own frame; zero if the scene stands still.
  Matrix6d covariance = Matrix6d::Zero();  ///< About the axes in rad/s, along them in m/s.
  bool is_moving = false;
  /// Where the speed is not certain, of each source: by how many standard deviations more points
  /// agree than at another speed, see leads_over_rivals. Nothing if no other speed has it
  /// elsewhere.
  std::vector<std::optional<double>> leads;
  std::vector<double> shift_std_m;  ///< What is not known of it moves each source by so much.

  /// Whether the speed has to be compared with others.
  bool is_in_doubt(const MotionOptions& options) const;
  /// Why the pose of a source cannot be relied on, in words and numbers; empty if it can.
  std::string rejection(std::size_t source, const MotionOptions& options) const;
};

/// The motion of scene `s` in `state`. What moves by itself may decide between two velocities: that
/// in the state `every_patch`, in which no patch loses weight, is then another, and by so much the
/// velocity is not known.
SceneMotion motion_of(const JointScene& scene, std::size_t s, const JointState& state,
                      const std::optional<JointState>& every_patch, const JointOptions& options,
                      const MotionOptions& motion_options);

/// The axis in the plane of x and y along which a scene moves the most, for all that is known: the
/// first of the second moment of its velocity, which has the mean `velocity` and the covariance of
/// `motion`. A unit vector that points where the velocity does, else where x does.
Eigen::Vector3d axis_of_motion(const SceneMotion& motion, const Twist& velocity);

}  // namespace croon

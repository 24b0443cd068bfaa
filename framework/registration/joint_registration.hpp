#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/params/table.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// A scan and when each of its points was measured.
struct TimedScan {
  std::shared_ptr<const Cloud> cloud;
  std::vector<double> times_s;  ///< One per point, by the sensor's clock.
};

/// What a rig sees in one place: the scan of the target and those of other sensors.
struct JointScene {
  struct Source {
    std::size_t sensor = 0;  ///< An index into JointState::T_target_sensor.
    TimedScan scan;
  };
  TimedScan target;
  std::vector<Source> sources;
  double reference_s = 0.0;  ///< The points are compared where they were at this time.
  bool is_moving = false;    ///< Whether the velocity is unknown; else it keeps its start.
  /// Of the velocity, which is expected to be zero, before any point is seen: about the axes in
  /// rad/s, along them in m/s. Without it JointOptions::velocity_std.
  std::optional<Matrix6d> velocity_covariance;
  /// The velocity that a step before has removed; the unknown one is added to it.
  Twist removed = {};
};

/// The unknowns of a joint registration.
struct JointState {
  std::vector<RigidTransform> T_target_sensor;  ///< By sensor.
  std::vector<double> clock_offsets_s;  ///< By sensor: added to its times, they are the target's.
  std::vector<Twist> velocities;        ///< Of the target, by scene, in its own frame; constant.
};

/// The parameters of `register_jointly`.
struct JointOptions {
  std::vector<double> max_distances_m = {0.3};
  std::vector<double> velocity_std = {30.0, 1.0};
  double clock_offset_std_s = 0.0;
  int max_iterations = 30;
  int points = 3000;
  int normal_neighbours = 10;
  double max_normal_angle_deg = 45.0;
  double patch_m = 3.0;
  double patch_balance = 0.8;
  double patch_kernel_m = 0.03;
  double vehicle_weight = 1.0;
  double kernel_width_m = 0.05;
};

/// The rows of JointOptions.
const params::Table<JointOptions>& joint_table();

/// The result of a joint registration.
struct JointRegistration {
  JointState state;
  /// Root of the weighted mean of the squared residuals, of all pairs, before the last step.
  double rmse_m = 0.0;
  int iterations = 0;
  bool converged = false;
  std::vector<std::vector<int>> correspondences;  ///< Of each scene's sources, before it too.
};

/// A source with fewer correspondences does not take part in an iteration.
inline constexpr int kLeastJointCorrespondences = 30;

/// Registers all sensors in all scenes at once, from `start`: one pose per sensor, and one velocity
/// for each scene that moves. A point s of a sensor that was measured at time t has the residual
/// `n . (exp(xi (t + d)) T s - exp(xi t') p)` for the nearest point p of the target, which was
/// measured at t' and has the normal n (point to plane, Chen & Medioni 1992, with the constant
/// velocity xi of Zhang & Singh 2014 and the clock's offset d). Where a step before has removed the
/// velocity xi_0 by the sensor's own clock, `exp(xi_0 d) T` stands in place of T. Gauss-Newton with
/// a robust kernel; all unknowns are solved for together. A sensor that does not take part keeps
/// its start.
///
/// One scene cannot tell a clock's offset from a shift of its sensor along the velocity; scenes of
/// different velocities with common poses can.
JointRegistration register_jointly(const std::vector<JointScene>& scenes, JointState start,
                                   const JointOptions& options);

}  // namespace croon

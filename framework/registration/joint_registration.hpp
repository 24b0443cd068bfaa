#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/params/table.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// A scan and the measurement times of its points.
struct TimedScan {
  std::shared_ptr<const Cloud> cloud;
  std::vector<double> times_s;  ///< One per point, by the sensor's clock.
};

/// The scans of a rig at one moment: that of the target and those of other sensors.
struct JointScene {
  struct Source {
    std::size_t sensor = 0;  ///< An index into JointState::T_target_sensor.
    TimedScan scan;
  };
  TimedScan target;
  std::vector<Source> sources;
  double reference_s = 0.0;  ///< Points are compared at their positions at this time.
  bool is_moving = false;    ///< Whether the velocity is unknown; else it keeps its initial value.
  /// The prior covariance of the velocity about zero: about the axes in rad/s, along them in m/s.
  /// Without it JointOptions::velocity_std applies.
  std::optional<Matrix6d> velocity_covariance;
  /// The velocity that an earlier step has removed; the unknown one is added to it.
  Twist removed = {};
};

/// The unknowns of a joint registration.
struct JointState {
  std::vector<RigidTransform> T_target_sensor;  ///< By sensor.
  /// By sensor: the offset to be added to its times to obtain those of the target.
  std::vector<double> clock_offsets_s;
  std::vector<Twist> velocities;  ///< Of the target, by scene, in its own frame; constant.
};

/// The parameters of `register_jointly`.
struct JointOptions {
  std::vector<double> max_distances_m = {0.3};
  std::vector<double> velocity_std = {30.0, 1.0};
  double clock_offset_std_s = 0.0;
  int max_iterations = 30;
  std::vector<double> step_tolerance = {0.1, 0.03};
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
  /// Root of the weighted mean of the squared residuals of all pairs, before the last step.
  double rmse_m = 0.0;
  int iterations = 0;
  bool converged = false;
  std::vector<std::vector<int>> correspondences;  ///< By scene and source, before the last step.
};

/// A source with fewer correspondences is skipped in an iteration.
inline constexpr int kMinJointCorrespondences = 30;

/// Registers all sensors in all scenes at once, starting at `start`: one pose per sensor, and one
/// velocity per moving scene. A point s of a sensor, measured at time t, has the residual
/// `n . (exp(xi (t + d)) T s - exp(xi t') p)` to the nearest point p of the target, which was
/// measured at t' and has the normal n (point to plane, Chen & Medioni 1992, with the constant
/// velocity xi of Zhang & Singh 2014 and the clock offset d). If an earlier step has removed the
/// velocity xi_0 using the sensor's own clock, `exp(xi_0 d) T` replaces T. Gauss-Newton with a
/// robust kernel, jointly over all unknowns. A sensor that is skipped keeps its initial pose.
///
/// A single scene cannot distinguish a clock offset from a translation of the sensor along the
/// velocity; scenes with different velocities and common poses can.
JointRegistration register_jointly(const std::vector<JointScene>& scenes, JointState start,
                                   const JointOptions& options);

}  // namespace croon

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/calibration/loaded_scene.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/registration/joint_registration.hpp"

namespace croon {

/// The registration of one sensor in one scan, compared with its given pose.
struct SensorAudit {
  std::string why_not;  ///< Why there is no estimate; empty if there is one.
  /// The `pose_error` of the registered pose from the given one: how far the sensor has moved; rad
  /// and m. Its covariance is that of one scan by itself, without the scatter of real scenes.
  Vector6d difference = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Zero();
};

/// The points of a scan that are used, with their times; zero without times.
struct ThinnedScan {
  Points points;
  std::vector<double> times_s;
  bool has_times = false;
};

/// Registers the sensors of a rig in one scan after another, near their given poses, with a few
/// points, so that it keeps up with a drive. All sensors of a scan are registered together with the
/// velocity of the rig (`register_jointly`). Its prior is the motion of the reference since the
/// scan before: within one scan, a wrong speed looks like a moved sensor.
///
/// The covariance is the jackknife over cubes of space with the velocity as a further unknown (see
/// pose_uncertainty and velocity_covariance), plus that of independent errors of single points,
/// which is large along directions that the scan does not constrain.
class Auditor {
 public:
  /// `given` has `T_reference_sensor` of each sensor, in the order of the scans. If `at_rest`,
  /// times are not used.
  Auditor(std::vector<RigidTransform> given, bool at_rest);

  /// The next scan: the cloud of the reference and one per sensor, in their order; std::nullopt for
  /// a sensor without a cloud. Scans that are not usable make their sensors, or all, undecidable.
  /// `stamp_s` is the time of the scan if known; otherwise times of points must go on from scan to
  /// scan for the velocity to be found.
  std::vector<SensorAudit> audit(ReadScan reference, std::vector<std::optional<ReadScan>> sensors,
                                 std::optional<double> stamp_s);

 private:
  /// Sets the velocity to that since the last scan, and returns its covariance; std::nullopt if
  /// there is none.
  std::optional<Matrix6d> find_velocity(const ThinnedScan& reference, double reference_s,
                                        std::optional<double> stamp_s);

  std::vector<RigidTransform> given_;
  bool at_rest_;
  std::optional<Twist> velocity_;  ///< Of the reference in its own frame; nothing if unknown.
  TimedScan last_reference_;       ///< Without distortion; its cloud is null if there is none.
  double last_reference_s_ = 0.0;
  std::optional<double> last_stamp_s_;
};

}  // namespace croon

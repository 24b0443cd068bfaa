#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/geometry/pose_covariance.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// The estimate of one sensor's pose in one scene.
struct SceneEstimate {
  std::string scene;
  /// T_reference_sensor; std::nullopt if a step failed.
  std::optional<RigidTransform> T_reference_sensor;
  std::optional<PoseCovariance> covariance;  ///< With the error budget, as that of a sensor.
  /// Why the pose was rejected or not used, or the step failed; empty if it was used.
  std::string reason;
  bool is_outlier = false;  ///< Accepted, but not used: it differs from that of the other scenes.
  std::optional<Matrix6d> error_budget = {};  ///< As that of a sensor.
};

/// The pose to which a sensor moves from the result if it is registered with the other sensors'
/// surfaces: an independent check.
struct Refit {
  double rotation_rad = 0.0;   ///< From the result.
  double translation_m = 0.0;  ///< From the result.
  /// Root mean square of the distances along the normals by which the surfaces move: not affected
  /// by unobservable directions.
  double surface_shift_m = 0.0;
};

/// The result for one sensor: one pose from all scenes.
struct CalibratedSensor {
  std::string sensor;
  bool is_accepted = false;
  /// T_reference_sensor; for a rejected sensor the best guess, or std::nullopt if there is none.
  std::optional<RigidTransform> T_reference_sensor;
  /// See PoseCovariance for its frame and units. It includes `error_budget`; the rest is
  /// statistical: it follows from the scatter of the data.
  std::optional<PoseCovariance> covariance;
  std::vector<std::string> reasons;       ///< Why it was rejected; empty if accepted.
  std::vector<std::string> advice;        ///< What would help; empty if accepted.
  std::optional<RigidTransform> nominal;  ///< The nominal T_reference_sensor.
  std::vector<SceneEstimate> scenes;      ///< By scene, in the order of the recording.
  /// The part of `covariance` that systematic errors of real LiDARs cause (add_error_budget);
  /// std::nullopt if it is unknown.
  std::optional<Matrix6d> error_budget = {};
  std::optional<Refit> refit = {};  ///< In the shown scene; std::nullopt without overlap in it.
};

/// The estimate of the rig's motion in one scene.
struct SceneMotionEstimate {
  std::string scene;
  Twist velocity;  ///< Of the reference, in its own frame; zero if the rig was at rest.
  Matrix6d covariance = Matrix6d::Zero();  ///< Angular velocity in rad/s, then linear in m/s.
};

/// The reference's pose above the road, from its own ground plane. T_road_reference has the
/// rotation Ry(pitch) Rx(roll), no yaw, and the translation (0, 0, height): z of the road's frame
/// points up, its origin is on the road below the reference.
struct GroundPose {
  double roll_rad = 0.0, pitch_rad = 0.0, height_m = 0.0;
  double roll_std_rad = 0.0, pitch_std_rad = 0.0, height_std_m = 0.0;
};

/// The rig's direction of travel in the frame of its reference: straight ahead of the vehicle.
struct HeadingOfTravel {
  /// Yaw of the direction of travel in the levelled frame of the reference (GroundPose; without one
  /// the reference's own frame): the yaw of the reference in the vehicle frame is its negative.
  double yaw_rad = 0.0;
  double yaw_std_rad = 0.0;
  std::size_t scenes = 0;  ///< Number of scenes that it was computed from.
};

/// The pose of a sensor after a step of the pipeline.
struct StepPose {
  std::string step;
  RigidTransform T_reference_sensor;
};

/// One sensor in the shown scene.
struct ShownSensor {
  std::string sensor;
  std::shared_ptr<const Cloud> cloud;   ///< As the last step used it: thinned, motion removed.
  std::vector<StepPose> path;           ///< After each step that changed the pose.
  std::optional<RigidTransform> rival;  ///< The best pose that a global search found elsewhere.
};

/// The clouds of the scene that reports show: the first with the maximum number of sensors.
struct ShownScene {
  std::string scene;
  std::shared_ptr<const Cloud> reference;
  std::vector<ShownSensor> sensors;  ///< Those with a cloud.
};

/// A rig's calibration.
struct CalibratedRig {
  std::string reference;
  std::vector<CalibratedSensor> sensors;  ///< In the order of the recording.
  /// Name of the pipeline that was used: "best", a file name.
  std::string composition;
  std::string
      composition_reason;  ///< How it treats motion; empty if that does not depend on the times.
  std::vector<std::string> warnings;  ///< One sentence each.
  std::vector<Fault> notes;           ///< Former names of keys in the pipeline, each once.
  std::vector<std::string> unused;    ///< Scenes and clouds that were not used, with the reasons.
  std::vector<SceneMotionEstimate> motion;  ///< For the scenes in which a velocity was estimated.
  std::optional<GroundPose> ground;         ///< Set if the reference sees the ground.
  std::optional<HeadingOfTravel> heading = {};  ///< Set if the rig drives straight in a scene.
  ShownScene shown = {};
};

}  // namespace croon

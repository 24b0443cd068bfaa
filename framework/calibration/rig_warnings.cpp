#include <algorithm>
#include <set>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/fit_check.hpp"
#include "framework/calibration/warnings.hpp"
#include "framework/geometry/dof.hpp"

namespace croon {
namespace {

/// Minimum distance between two LiDARs, given their housings.
constexpr double kSamePlace_m = 0.05;
constexpr double kSameRotation_rad = rad_from_deg(2.0);

/// Distances from the nominal pose above which a pose is suspicious.
constexpr double kFar_m = 0.3;
constexpr double kFar_rad = rad_from_deg(5.0);

/// Length that is equivalent to a radian when distances are compared.
constexpr double kMetresPerRadian = 2.0;

bool is_same_pose(const RigidTransform& a, const RigidTransform& b) {
  const PoseError error = pose_error(a, b);
  return error.rotation_rad < kSameRotation_rad && error.translation_m < kSamePlace_m;
}

bool is_far(const RigidTransform& pose, const RigidTransform& nominal) {
  const PoseError error = pose_error(pose, nominal);
  return error.rotation_rad > kFar_rad || error.translation_m > kFar_m;
}

double distance(const RigidTransform& a, const RigidTransform& b) {
  const PoseError error = pose_error(a, b);
  return error.rotation_rad + error.translation_m / kMetresPerRadian;
}

/// Whether `b` is much nearer than `a`, both distances from a nominal pose.
bool is_much_nearer(double b, double a) { return b < a / 3.0; }

/// "12.3° and 0.41 m".
std::string distance_text(const RigidTransform& a, const RigidTransform& b) {
  const PoseError error = pose_error(a, b);
  return fixed_number(deg_from_rad(error.rotation_rad), 1) + "° and " +
         fixed_number(error.translation_m, 2) + " m";
}

/// The result of a sensor and its nominal pose.
struct ComparedSensor {
  std::string name;
  RigidTransform pose, nominal;

  double distance() const { return croon::distance(pose, nominal); }
};

/// The accepted sensors with a nonzero nominal pose.
std::vector<ComparedSensor> compared_sensors(const CalibratedRig& rig) {
  std::vector<ComparedSensor> compared;
  for (const CalibratedSensor& sensor : rig.sensors) {
    if (!sensor.is_accepted || !sensor.T_reference_sensor || !sensor.nominal) continue;
    if (is_same_pose(*sensor.nominal, {})) continue;  // A placeholder.
    compared.push_back({printable(sensor.sensor), *sensor.T_reference_sensor, *sensor.nominal});
  }
  return compared;
}

/// Warns about pairs whose nominal poses fit better when swapped; returns their names.
std::set<std::string> warn_of_swaps(const std::vector<ComparedSensor>& sensors,
                                    std::vector<std::string>& warnings) {
  std::set<std::string> swapped;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    for (std::size_t j = i + 1; j < sensors.size(); ++j) {
      const ComparedSensor& a = sensors[i];
      const ComparedSensor& b = sensors[j];
      if (!is_far(a.pose, a.nominal) || !is_far(b.pose, b.nominal)) continue;
      if (!is_much_nearer(distance(a.pose, b.nominal), a.distance()) ||
          !is_much_nearer(distance(b.pose, a.nominal), b.distance())) {
        continue;
      }
      swapped.insert({a.name, b.name});
      warnings.push_back(a.name + " and " + b.name +
                         " look swapped: each is at the nominal pose of the other (to within " +
                         distance_text(a.pose, b.nominal) + ", and " +
                         distance_text(b.pose, a.nominal) + ")");
    }
  }
  return swapped;
}

/// Describes how far a pose is from its nominal pose, and a possible cause.
std::string far_text(const ComparedSensor& sensor) {
  constexpr double kHalfTurn_rad = rad_from_deg(165.0);
  const std::string distance = distance_text(sensor.pose, sensor.nominal);
  if (is_much_nearer(croon::distance(sensor.pose, sensor.nominal.inverse()), sensor.distance())) {
    return "is " + distance +
           " from its nominal pose, but near its inverse: does the nominal pose map the reference "
           "to the sensor?";
  }
  if (pose_error(sensor.pose, sensor.nominal).rotation_rad > kHalfTurn_rad) {
    return "is half a turn from its nominal pose (" + distance +
           "): is the nominal pose correct? If so, do not use the result: the scene may look the "
           "same after half a turn";
  }
  return "is " + distance + " from its nominal pose";
}

void warn_of_nominal(const CalibratedRig& rig, std::vector<std::string>& warnings) {
  const std::vector<ComparedSensor> sensors = compared_sensors(rig);
  const std::set<std::string> swapped = warn_of_swaps(sensors, warnings);
  for (const ComparedSensor& sensor : sensors) {
    if (swapped.count(sensor.name) > 0 || !is_far(sensor.pose, sensor.nominal)) continue;
    warnings.push_back(sensor.name + " " + far_text(sensor));
  }
}

/// A pose of one of the rig's sensors.
struct NamedPose {
  std::string name;
  RigidTransform pose;
};

/// Warns about poses at zero and pairs at the same pose.
void warn_of_same_poses(const std::vector<NamedPose>& poses, const std::string& at_zero,
                        const std::string& at_one, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (is_same_pose(poses[i].pose, {})) {
      warnings.push_back(poses[i].name + " " + at_zero);
      continue;
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (!is_same_pose(poses[i].pose, poses[j].pose)) continue;
      warnings.push_back(poses[j].name + " and " + poses[i].name + " " + at_one);
    }
  }
}

}  // namespace

std::vector<std::string> warnings_about_rig(const CalibratedRig& rig) {
  std::vector<std::string> warnings;
  std::vector<NamedPose> results, nominal;
  bool is_one_scene = false;
  for (const CalibratedSensor& sensor : rig.sensors) {
    const std::string name = printable(sensor.sensor);
    const bool is_as_nominal = sensor.is_accepted && sensor.nominal && sensor.T_reference_sensor &&
                               is_same_pose(*sensor.nominal, *sensor.T_reference_sensor);
    if (sensor.nominal && !is_as_nominal) nominal.push_back({name, *sensor.nominal});
    for (const SceneEstimate& scene : sensor.scenes) {
      if (!scene.is_outlier) continue;
      warnings.push_back("scene " + printable(scene.scene) + " is not used for " + name +
                         ": was the sensor moved, or the scan distorted? " + scene.reason);
    }
    if (!sensor.is_accepted || !sensor.T_reference_sensor) continue;
    if (is_doubtful(sensor)) {
      warnings.push_back("the clouds contradict the pose of " + name + ": " +
                         refit_text(*sensor.refit) + "; find the reason before you use it");
    }
    results.push_back({name, *sensor.T_reference_sensor});
    const auto is_accepted_in = [](const SceneEstimate& scene) { return scene.reason.empty(); };
    is_one_scene = is_one_scene ||
                   std::count_if(sensor.scenes.begin(), sensor.scenes.end(), is_accepted_in) == 1;
  }
  warn_of_same_poses(nominal, "has a nominal pose of zero: is it a placeholder?",
                     "have the same nominal pose: is one of them a placeholder?", warnings);
  warn_of_same_poses(
      results,
      "is at the pose of the reference: its cloud is already in the frame of the "
      "reference, or measured by the same sensor",
      "have the same pose: are they clouds of the same sensor, or already in one frame?", warnings);
  warn_of_nominal(rig, warnings);
  if (is_one_scene) {
    warnings.emplace_back(
        "the poses are from one scene: on real vehicles, yaw usually differs by 0.1 to 0.2° "
        "between scenes; more scenes average it out");
  }
  return warnings;
}

}  // namespace croon

#include "experiments/report/calibration_text.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/geometry/dof.hpp"

namespace croon::experiments {
namespace {

/// "1.2, 0.4, 3.0": three standard deviations, each multiplied by `scale`.
std::string stds_text(const Matrix6d& covariance, int first, double scale, int decimals) {
  std::string text;
  for (int i = first; i < first + 3; ++i) {
    text +=
        (text.empty() ? "" : ", ") + fixed_number(scale * std::sqrt(covariance(i, i)), decimals);
  }
  return text;
}

std::string axis_text(const std::string& name, double value, int decimals) {
  return name + " " + right_aligned(fixed_number(value, decimals), 9);
}

/// Two lines: translation and rotation with their standard deviations.
std::string pose_text(const RigidTransform& T, const std::optional<PoseCovariance>& covariance,
                      const std::string& indent) {
  const Eigen::Vector3d rpy_deg = rpy_from_rotation(T.rotation) * deg_from_rad(1.0);
  std::string text = indent + axis_text("x   ", T.translation.x(), 4) + "  " +
                     axis_text("y    ", T.translation.y(), 4) + "  " +
                     axis_text("z  ", T.translation.z(), 4) + " m  ";
  if (covariance) text += "  std " + stds_text(covariance->matrix, 3, 1e3, 1) + " mm";
  text += "\n" + indent + axis_text("roll", rpy_deg.x(), 4) + "  " +
          axis_text("pitch", rpy_deg.y(), 4) + "  " + axis_text("yaw", rpy_deg.z(), 4) + " deg";
  if (covariance) {
    text += "  std " + stds_text(covariance->matrix, 0, deg_from_rad(1.0), 3) + " deg";
  }
  return text + "\n";
}

/// A line with the degrees of freedom that are weakly constrained or unobservable; empty if all are
/// determined.
std::string observability_text(const std::optional<PoseCovariance>& covariance,
                               const std::string& indent) {
  if (!covariance) return "";
  std::string text;
  for (const Observability word : {Observability::weak, Observability::unobservable}) {
    std::string names;
    for (std::size_t i = 0; i < kDofNames.size(); ++i) {
      if (covariance->dofs.at(i) == word) names += (names.empty() ? "" : ", ") + kDofNames.at(i);
    }
    if (names.empty()) continue;
    text += indent + (word == Observability::weak ? "weakly constrained: " : "not constrained: ") +
            names + "\n";
  }
  return text;
}

std::string apart_text(const RigidTransform& a, const RigidTransform& b) {
  const PoseError apart = pose_error(a, b);
  return fixed_number(deg_from_rad(apart.rotation_rad), 2) + " deg and " +
         fixed_number(1e3 * apart.translation_m, 0) + " mm";
}

/// The number of scenes in which the pose was accepted, and how much their poses differ from it.
std::string scenes_text(const CalibratedSensor& sensor) {
  if (sensor.scenes.size() < 2 || !sensor.T_reference_sensor) return "";
  std::size_t accepted = 0;
  PoseError max_apart;
  for (const SceneEstimate& scene : sensor.scenes) {
    if (!scene.reason.empty() || !scene.T_reference_sensor) continue;
    ++accepted;
    const PoseError apart = pose_error(*scene.T_reference_sensor, *sensor.T_reference_sensor);
    max_apart.rotation_rad = std::max(max_apart.rotation_rad, apart.rotation_rad);
    max_apart.translation_m = std::max(max_apart.translation_m, apart.translation_m);
  }
  std::string text =
      "  accepted in " + std::to_string(accepted) + " of " + counted(sensor.scenes.size(), "scene");
  if (accepted > 1) {
    text += "; single scenes differ from the pose by up to " +
            fixed_number(deg_from_rad(max_apart.rotation_rad), 2) + " deg and " +
            fixed_number(1e3 * max_apart.translation_m, 0) + " mm";
  }
  return text + "\n";
}

std::string list_text(const std::string& title, const std::vector<std::string>& lines,
                      const std::string& indent = "") {
  std::string text;
  for (const std::string& line : lines) {
    text += indent + (title.empty() ? "" : title + " ") + printable(line) + "\n";
  }
  return text;
}

std::string verdict_text(bool is_accepted, bool colours) {
  const std::string word = is_accepted ? "ACCEPTED" : "REJECTED";
  if (!colours) return word;
  return (is_accepted ? "\033[32m" : "\033[31m") + word + "\033[0m";
}

std::string sensor_text(const CalibratedSensor& sensor, const std::string& reference,
                        bool colours) {
  std::string text = verdict_text(sensor.is_accepted, colours) + "  " + printable(sensor.sensor) +
                     "  (in the frame of " + printable(reference) + ")\n";
  if (sensor.is_accepted) {
    text += pose_text(*sensor.T_reference_sensor, sensor.covariance, "  ");
    text += observability_text(sensor.covariance, "  ") + scenes_text(sensor);
  } else {
    text += list_text("why:", sensor.reasons, "  ") + list_text("help:", sensor.advice, "  ");
    if (sensor.T_reference_sensor) {
      text += "  best guess, not to be used unchecked:\n" +
              pose_text(*sensor.T_reference_sensor, sensor.covariance, "    ");
    } else {
      text += "  there is no best guess\n";
    }
  }
  if (sensor.nominal && sensor.T_reference_sensor) {
    text += "  from nominal: " + apart_text(*sensor.T_reference_sensor, *sensor.nominal) + "\n";
  }
  return text + "\n";
}

std::string motion_text(const SceneMotionEstimate& motion) {
  const Eigen::Vector3d& v = motion.velocity.linear_mps;
  const double turning_degps = deg_from_rad(motion.velocity.angular_radps.norm());
  if (v.norm() == 0.0 && turning_degps == 0.0) return "stationary";
  return fixed_number(v.norm(), 2) + " m/s, " + fixed_number(turning_degps, 1) + " deg/s";
}

std::string motions_text(const std::vector<SceneMotionEstimate>& motions) {
  std::string text;
  for (const SceneMotionEstimate& motion : motions) {
    text += text.empty() ? "motion:  " : "; ";
    if (motions.size() > 1) text += printable(motion.scene) + ": ";
    text += motion_text(motion);
  }
  return text.empty() ? "" : text + "\n";
}

std::string ground_text(const GroundPose& ground) {
  const auto with_std = [](double value, double std, int decimals) {
    return fixed_number(value, decimals) + " +- " + fixed_number(std, decimals);
  };
  return "ground:  roll " +
         with_std(deg_from_rad(ground.roll_rad), deg_from_rad(ground.roll_std_rad), 2) +
         " deg, pitch " +
         with_std(deg_from_rad(ground.pitch_rad), deg_from_rad(ground.pitch_std_rad), 2) +
         " deg, height " + with_std(ground.height_m, ground.height_std_m, 3) +
         " m of the reference over the road\n";
}

std::string heading_text(const HeadingOfTravel& heading) {
  return "heading: yaw " + fixed_number(deg_from_rad(heading.yaw_rad), 2) + " +- " +
         fixed_number(deg_from_rad(heading.yaw_std_rad), 2) +
         " deg, the direction of travel in the frame of the reference\n";
}

}  // namespace

std::string calibration_text(const CalibratedRig& rig, bool colours) {
  const auto accepted =
      std::count_if(rig.sensors.begin(), rig.sensors.end(),
                    [](const CalibratedSensor& sensor) { return sensor.is_accepted; });
  std::string text = std::to_string(accepted) + " of " + counted(rig.sensors.size(), "sensor") +
                     " accepted\npipeline: " + printable(rig.composition);
  if (!rig.composition_reason.empty()) text += "; " + printable(rig.composition_reason);
  text += "\n\n";
  for (const CalibratedSensor& sensor : rig.sensors) {
    text += sensor_text(sensor, rig.reference, colours);
  }
  text += motions_text(rig.motion);
  if (rig.ground) text += ground_text(*rig.ground);
  if (rig.heading) text += heading_text(*rig.heading);
  return text + list_text("warning:", rig.warnings) + list_text("not used:", rig.unused);
}

}  // namespace croon::experiments

#include "experiments/report/calibration_document.hpp"

#include <algorithm>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/extrinsics.hpp"
#include "framework/calibration/fit_check.hpp"
#include "framework/document/renderers.hpp"
#include "framework/geometry/dof.hpp"

namespace croon::experiments {
namespace {

std::string axis_text(const std::string& name, double value, int decimals) {
  return name + " " + right_aligned(fixed_number(value, decimals), 9);
}

/// Two lines: translation and rotation with their standard deviations.
std::string pose_text(const RigidTransform& T, const std::optional<PoseCovariance>& covariance) {
  const Eigen::Vector3d rpy_deg = rpy_from_rotation(T.rotation) * deg_from_rad(1.0);
  std::string text = axis_text("x   ", T.translation.x(), 4) + "  " +
                     axis_text("y    ", T.translation.y(), 4) + "  " +
                     axis_text("z  ", T.translation.z(), 4) + " m  ";
  if (covariance) text += "  std " + stds_text(*covariance, 3, 1e3, 1) + " mm";
  text += "\n" + axis_text("roll", rpy_deg.x(), 4) + "  " + axis_text("pitch", rpy_deg.y(), 4) +
          "  " + axis_text("yaw", rpy_deg.z(), 4) + " deg";
  if (covariance) {
    text += "  std " + stds_text(*covariance, 0, deg_from_rad(1.0), 3) + " deg";
  }
  return text + "\n";
}

/// The part of the standard deviations that the data do not show.
std::string budget_text(const Matrix6d& error_budget) {
  const PoseCovariance budget = {error_budget, {}};
  return "std includes systematic errors of LiDARs: " + stds_text(budget, 3, 1e3, 1) + " mm, " +
         stds_text(budget, 0, deg_from_rad(1.0), 3) + " deg";
}

/// Adds the degrees of freedom that are weakly constrained or unobservable.
void add_observability(const std::optional<PoseCovariance>& covariance,
                       std::vector<std::string>& lines) {
  if (!covariance) return;
  for (const Observability word : {Observability::weak, Observability::unobservable}) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < kDofNames.size(); ++i) {
      if (covariance->dofs.at(i) == word) names.push_back(kDofNames.at(i));
    }
    if (names.empty()) continue;
    lines.push_back((word == Observability::weak ? "weakly constrained: " : "not constrained: ") +
                    list_text(names));
  }
}

std::string apart_text(const PoseError& apart) {
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
      "accepted in " + std::to_string(accepted) + " of " + counted(sensor.scenes.size(), "scene");
  if (accepted > 1) {
    text += "; single scenes differ from the pose by up to " + apart_text(max_apart);
  }
  return text;
}

/// Every format of extrinsics that fits one file, to be copied.
std::vector<CopyText> pose_copies(const CalibratedSensor& sensor, const std::string& reference) {
  const Extrinsics extrinsics = {reference,
                                 {{sensor.sensor, *sensor.T_reference_sensor, sensor.is_accepted,
                                   sensor.covariance, true, is_doubtful(sensor)}}};
  std::vector<CopyText> copies;
  for (const std::string& format : extrinsics_format_names()) {
    const std::vector<ExtrinsicsFile> files = write_extrinsics(extrinsics, format, true);
    if (files.size() == 1) copies.push_back({format, files.front().text});
  }
  return copies;
}

Card sensor_card(const CalibratedSensor& sensor, const std::string& reference) {
  Card card;
  card.title = sensor.sensor + "  (in the frame of " + reference + ")";
  card.tone = sensor.is_accepted ? Tone::accepted : Tone::rejected;
  card.status = sensor.is_accepted ? "accepted" : "rejected";
  if (is_doubtful(sensor)) {
    card.tone = Tone::warning;
    card.status = "accepted, but contradicted by the clouds: do not use unchecked";
  }
  if (sensor.refit) card.lines.push_back(fit_sentence(sensor.refit));
  if (!sensor.is_accepted) {
    for (const std::string& reason : sensor.reasons) card.lines.push_back("why: " + reason);
    for (const std::string& advice : sensor.advice) card.lines.push_back("help: " + advice);
    card.lines.emplace_back(sensor.T_reference_sensor ? "best guess, not to be used unchecked:"
                                                      : "there is no best guess");
  }
  if (!sensor.T_reference_sensor) return card;
  card.details = pose_text(*sensor.T_reference_sensor, sensor.covariance);
  std::vector<std::string> notes;
  if (sensor.error_budget) notes.push_back(budget_text(*sensor.error_budget));
  if (sensor.is_accepted) {
    add_observability(sensor.covariance, notes);
    if (const std::string scenes = scenes_text(sensor); !scenes.empty()) notes.push_back(scenes);
  }
  if (sensor.nominal) {
    notes.push_back("from nominal: " +
                    apart_text(pose_error(*sensor.T_reference_sensor, *sensor.nominal)));
  }
  for (const std::string& note : notes) card.details += note + "\n";
  card.copies = pose_copies(sensor, reference);
  return card;
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
    text += text.empty() ? "" : "; ";
    if (motions.size() > 1) text += motion.scene + ": ";
    text += motion_text(motion);
  }
  return text;
}

std::string ground_text(const GroundPose& ground) {
  const auto with_std = [](double value, double std, int decimals) {
    return fixed_number(value, decimals) + " +- " + fixed_number(std, decimals);
  };
  return "roll " + with_std(deg_from_rad(ground.roll_rad), deg_from_rad(ground.roll_std_rad), 2) +
         " deg, pitch " +
         with_std(deg_from_rad(ground.pitch_rad), deg_from_rad(ground.pitch_std_rad), 2) +
         " deg, height " + with_std(ground.height_m, ground.height_std_m, 3) +
         " m of the reference over the road";
}

std::string heading_text(const HeadingOfTravel& heading) {
  return "yaw " + fixed_number(deg_from_rad(heading.yaw_rad), 2) + " +- " +
         fixed_number(deg_from_rad(heading.yaw_std_rad), 2) +
         " deg, the direction of travel in the frame of the reference";
}

}  // namespace

std::string accepted_sentence(const CalibratedRig& rig) {
  const auto accepted =
      std::count_if(rig.sensors.begin(), rig.sensors.end(),
                    [](const CalibratedSensor& sensor) { return sensor.is_accepted; });
  std::string sentence =
      std::to_string(accepted) + " of " + counted(rig.sensors.size(), "sensor") + " accepted";
  std::vector<std::string> doubtful;
  for (const CalibratedSensor& sensor : rig.sensors) {
    if (is_doubtful(sensor)) doubtful.push_back(printable(sensor.sensor));
  }
  if (!doubtful.empty()) {
    sentence += ", but the clouds contradict the pose of " + list_text(doubtful);
  }
  return sentence;
}

Section verdict_section(const CalibratedRig& rig) {
  Cards cards;
  for (const CalibratedSensor& sensor : rig.sensors) {
    cards.cards.push_back(sensor_card(sensor, rig.reference));
  }
  Facts facts;
  if (!rig.motion.empty()) facts.facts.emplace_back("motion", motions_text(rig.motion));
  if (rig.ground) facts.facts.emplace_back("ground", ground_text(*rig.ground));
  if (rig.heading) facts.facts.emplace_back("heading", heading_text(*rig.heading));
  std::string pipeline = "pipeline: " + rig.composition;
  if (!rig.composition_reason.empty()) pipeline += "; " + rig.composition_reason;
  Section section{"verdict", "Verdict", {Paragraph{pipeline}, cards, facts}};
  for (const std::string& warning : rig.warnings) {
    section.blocks.emplace_back(Paragraph{warning, Tone::warning});
  }
  for (const std::string& unused : rig.unused) {
    section.blocks.emplace_back(Paragraph{"not used: " + unused});
  }
  return section;
}

std::string calibration_text(const CalibratedRig& rig, bool colours) {
  return accepted_sentence(rig) + "\n" + text_section(verdict_section(rig), colours);
}

}  // namespace croon::experiments

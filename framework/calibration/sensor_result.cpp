#include "framework/calibration/sensor_result.hpp"

#include <algorithm>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/reasons_in_words.hpp"
#include "framework/geometry/guarded_inverse.hpp"
#include "framework/geometry/pose_mean.hpp"

namespace croon {
namespace {

/// Why the result is not accepted, in the words of the steps.
std::string why_not(const MemberResult& result) {
  return result.failure.empty() ? result.estimate.rejection.value_or("") : result.failure;
}

SceneEstimate scene_estimate(const SceneResult& scene) {
  SceneEstimate estimate;
  estimate.scene = scene.scene;
  if (scene.result == nullptr) {
    estimate.reason = scene.why_not;
    return estimate;
  }
  const MemberResult& result = *scene.result;
  if (result.has_pose) {
    estimate.T_reference_sensor = result.T_in_scene;
    estimate.covariance = result.covariance_in_scene;
  }
  if (!result.is_accepted()) {
    estimate.reason = list_text(reasons_in_words(why_not(result), std::nullopt).reasons, " ");
  }
  return estimate;
}

/// For each degree of freedom, the best observability among the averaged poses.
DofObservability combined_observability(const std::vector<const MemberResult*>& results) {
  DofObservability observability = results.front()->estimate.covariance->dofs;
  for (const MemberResult* const result : results) {
    observability = best_observability(observability, result->estimate.covariance->dofs);
  }
  return observability;
}

/// Sets the common pose of `accepted`, which agree: the pose to which a step has set all of them,
/// or their mean.
void set_common_pose(CalibratedSensor& sensor, const std::vector<const MemberResult*>& accepted) {
  const Estimate& first = accepted.front()->estimate;
  const bool is_common =
      std::all_of(accepted.begin(), accepted.end(), [&](const MemberResult* result) {
        return result->estimate.T_target_source == first.T_target_source;
      });
  sensor.T_reference_sensor = first.T_target_source;
  sensor.covariance = first.covariance;
  if (is_common) return;
  std::vector<InformedPose> known;
  std::vector<RigidTransform> poses;
  for (const MemberResult* const result : accepted) {
    poses.push_back(result->estimate.T_target_source);
    if (!result->estimate.covariance) continue;
    known.push_back(informed(poses.back(), result->estimate.covariance->matrix));
  }
  if (known.size() < poses.size()) {
    sensor.T_reference_sensor = mean_pose(poses);
    sensor.covariance.reset();
    return;
  }
  const InformedPose mean = informed_mean(known);
  sensor.T_reference_sensor = mean.pose;
  sensor.covariance = {guarded_inverse<6>(mean.information), combined_observability(accepted)};
}

/// The accepted results in the scenes whose own poses agree with the majority.
std::vector<const MemberResult*> agreeing(const std::vector<const MemberResult*>& accepted) {
  std::vector<RigidTransform> poses;
  for (const MemberResult* const result : accepted) poses.push_back(result->T_in_scene);
  const RigidTransform centre = common_start(poses);
  std::vector<const MemberResult*> near;
  for (const MemberResult* const result : accepted) {
    if (agree(result->T_in_scene, centre, kNearStart)) near.push_back(result);
  }
  return near;
}

/// A sentence on the two accepted scenes whose poses differ the most.
std::string disagreement(const std::vector<SceneResult>& scenes) {
  std::string text;
  double largest_m = -1.0;
  for (const SceneResult& a : scenes) {
    for (const SceneResult& b : scenes) {
      if (&a >= &b || a.result == nullptr || b.result == nullptr) continue;
      if (!a.result->is_accepted() || !b.result->is_accepted()) continue;
      const PoseError apart = pose_error(a.result->T_in_scene, b.result->T_in_scene);
      const double size_m = apart.translation_m + 10.0 * apart.rotation_rad;
      if (size_m <= largest_m) continue;
      largest_m = size_m;
      text = "The poses of the scenes " + a.scene + " and " + b.scene + " are " +
             fixed_number(deg_from_rad(apart.rotation_rad), 2) + " degrees and " +
             fixed_number(apart.translation_m, 3) +
             " m apart, and no majority of the scenes agrees.";
    }
  }
  return text;
}

/// The pose nearest to the majority among those that were not accepted; null if there is none.
const MemberResult* best_guess(const std::vector<SceneResult>& scenes) {
  std::vector<const MemberResult*> results;
  std::vector<RigidTransform> poses;
  for (const SceneResult& scene : scenes) {
    if (scene.result == nullptr || !scene.result->has_pose) continue;
    results.push_back(scene.result);
    poses.push_back(scene.result->T_in_scene);
  }
  if (results.empty()) return nullptr;
  const RigidTransform centre = common_start(poses);
  const auto distance_m = [&](const MemberResult* result) {
    const PoseError apart = pose_error(result->T_in_scene, centre);
    return apart.translation_m + 10.0 * apart.rotation_rad;
  };
  return *std::min_element(
      results.begin(), results.end(),
      [&](const MemberResult* a, const MemberResult* b) { return distance_m(a) < distance_m(b); });
}

void set_guess(CalibratedSensor& sensor, const std::vector<SceneResult>& scenes) {
  if (const MemberResult* const guess = best_guess(scenes)) {
    sensor.T_reference_sensor = guess->T_in_scene;
    sensor.covariance = guess->covariance_in_scene;
  }
}

void add_once(std::vector<std::string>& list, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    if (std::find(list.begin(), list.end(), text) == list.end()) list.push_back(text);
  }
}

/// Adds the reasons from all scenes, prefixed with the scene's name if there are several.
void set_reasons(CalibratedSensor& sensor, const std::vector<SceneResult>& scenes) {
  for (const SceneResult& scene : scenes) {
    const std::string prefix = scenes.size() > 1 ? "Scene " + scene.scene + ": " : "";
    if (scene.result == nullptr) {
      sensor.reasons.push_back(prefix + scene.why_not);
      continue;
    }
    const ReasonsInWords explanation =
        reasons_in_words(why_not(*scene.result), scene.result->covariance_in_scene);
    sensor.reasons.push_back(prefix + list_text(explanation.reasons, " "));
    add_once(sensor.advice, explanation.advice);
  }
  if (scenes.empty()) sensor.reasons.emplace_back("No scene has a cloud of it.");
}

/// Rejects a pose whose standard deviations are too large for any application.
void reject_if_uncertain(CalibratedSensor& sensor) {
  constexpr double kMaxStd_deg = 0.5, kMaxStd_m = 0.1;
  if (!sensor.covariance) return;
  const Vector6d stds = sensor.covariance->matrix.diagonal().cwiseSqrt();
  const double rotation_deg = deg_from_rad(stds.head<3>().maxCoeff());
  const double translation_m = stds.tail<3>().maxCoeff();
  if (rotation_deg <= kMaxStd_deg && translation_m <= kMaxStd_m) return;
  sensor.is_accepted = false;
  sensor.reasons.push_back("The pose is uncertain: its standard deviations reach " +
                           fixed_number(rotation_deg, 2) + " degrees and " +
                           fixed_number(translation_m, 2) + " m.");
  sensor.advice.emplace_back("Record several scenes with surfaces in all directions.");
}

}  // namespace

CalibratedSensor sensor_result(const std::string& name, const std::vector<SceneResult>& scenes) {
  CalibratedSensor sensor;
  sensor.sensor = name;
  std::vector<const MemberResult*> accepted;
  for (const SceneResult& scene : scenes) {
    sensor.scenes.push_back(scene_estimate(scene));
    if (scene.result != nullptr && scene.result->is_accepted()) accepted.push_back(scene.result);
  }
  if (accepted.empty()) {
    set_guess(sensor, scenes);
    set_reasons(sensor, scenes);
    return sensor;
  }
  const std::vector<const MemberResult*> near = agreeing(accepted);
  set_common_pose(sensor, near.empty() ? accepted : near);
  sensor.is_accepted = 2 * near.size() > accepted.size();
  if (!sensor.is_accepted) {
    sensor.reasons.push_back(disagreement(scenes));
    sensor.advice.emplace_back(
        "Check that all scenes are of the same rig, or record more scenes at different places.");
  } else {
    reject_if_uncertain(sensor);
  }
  return sensor;
}

}  // namespace croon

#include "framework/calibration/sensor_result.hpp"

#include <algorithm>
#include <utility>

#include "framework/base/angles.hpp"
#include "framework/base/text.hpp"
#include "framework/calibration/reasons_in_words.hpp"
#include "framework/calibration/scene_agreement.hpp"
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

/// The accepted result of a scene.
struct AcceptedScene {
  std::size_t scene = 0;  ///< Its index.
  const MemberResult* result = nullptr;
};

/// A pose that is averaged.
struct CommonPose {
  RigidTransform pose;
  std::optional<PoseCovariance> covariance;
};

/// The mean of `poses`, without a covariance if one of them has none.
CommonPose mean_of(const std::vector<CommonPose>& poses) {
  std::vector<InformedPose> known;
  std::vector<RigidTransform> all;
  for (const CommonPose& one : poses) {
    all.push_back(one.pose);
    if (one.covariance) known.push_back(informed(one.pose, one.covariance->matrix));
  }
  if (known.size() < poses.size()) return {mean_pose(all), std::nullopt};
  const InformedPose mean = informed_mean(known);
  DofObservability observability = poses.front().covariance->dofs;
  for (const CommonPose& one : poses) {
    observability = best_observability(observability, one.covariance->dofs);
  }
  return {mean.pose, PoseCovariance{guarded_inverse<6>(mean.information), observability}};
}

/// Sets the common pose of `accepted`, which agree: the pose to which a step has set all of them,
/// or their mean. The former includes all scenes, so with `from_scenes` the mean of the poses of
/// the single scenes is used.
void set_common_pose(CalibratedSensor& sensor, const std::vector<AcceptedScene>& accepted,
                     bool from_scenes) {
  std::vector<CommonPose> poses;
  for (const AcceptedScene& one : accepted) {
    const MemberResult& result = *one.result;
    poses.push_back(from_scenes
                        ? CommonPose{result.T_in_scene, result.covariance_in_scene}
                        : CommonPose{result.estimate.T_target_source, result.estimate.covariance});
  }
  const bool is_common = std::all_of(poses.begin(), poses.end(), [&](const CommonPose& one) {
    return one.pose == poses.front().pose;
  });
  const CommonPose common = is_common ? poses.front() : mean_of(poses);
  sensor.T_reference_sensor = common.pose;
  sensor.covariance = common.covariance;
}

/// "0.98 degrees and 0.160 m".
std::string apart_text(const PoseError& apart) {
  return fixed_number(deg_from_rad(apart.rotation_rad), 2) + " degrees and " +
         fixed_number(apart.translation_m, 3) + " m";
}

/// "0.98 degrees and 0.160 m (9.1 standard deviations)".
std::string split_text(const SceneSplit& split) {
  return apart_text(split.apart) + " (" + fixed_number(split.deviations, 1) +
         " standard deviations)";
}

/// Marks the pose of `scene` as an outlier, which differs from the others by `difference`.
void exclude(CalibratedSensor& sensor, std::size_t scene, const std::string& difference) {
  sensor.scenes[scene].is_outlier = true;
  sensor.scenes[scene].reason =
      "The pose differs from that of the other scenes by " + difference + ".";
}

/// Removes the scenes whose own poses do not agree with the majority. Returns whether there is a
/// majority; without one, nothing is removed.
bool remove_far(CalibratedSensor& sensor, std::vector<AcceptedScene>& accepted) {
  std::vector<RigidTransform> poses;
  for (const AcceptedScene& one : accepted) poses.push_back(one.result->T_in_scene);
  const RigidTransform centre = common_start(poses);
  const auto far = std::stable_partition(
      accepted.begin(), accepted.end(),
      [&](const AcceptedScene& one) { return agree(one.result->T_in_scene, centre, kNearStart); });
  if (far - accepted.begin() <= accepted.end() - far) return false;
  for (auto one = far; one != accepted.end(); ++one) {
    exclude(sensor, one->scene, apart_text(pose_error(one->result->T_in_scene, centre)));
  }
  accepted.erase(far, accepted.end());
  return true;
}

/// The names of some of the accepted scenes, after commas.
std::string names_of(const std::vector<std::size_t>& group,
                     const std::vector<AcceptedScene>& accepted,
                     const std::vector<SceneResult>& scenes) {
  std::string text;
  for (const std::size_t i : group) {
    text += (text.empty() ? "" : ", ") + scenes[accepted[i].scene].scene;
  }
  return text;
}

/// Removes single scenes whose poses differ from those of at least three others, and rejects the
/// sensor if its pose still differs between scenes. Returns whether any scene was removed.
bool test_agreement(CalibratedSensor& sensor, std::vector<AcceptedScene>& accepted,
                    const std::vector<SceneResult>& scenes) {
  constexpr std::size_t kMinOthers = 3;
  bool is_any_removed = false;
  for (;;) {
    std::vector<ScenePose> poses;
    for (const AcceptedScene& one : accepted) {
      const std::optional<PoseCovariance>& covariance = one.result->covariance_in_scene;
      poses.push_back(
          {one.result->T_in_scene, covariance ? covariance->matrix : Matrix6d(Matrix6d::Zero())});
    }
    const std::optional<SceneSplit> split = split_of_scenes(poses);
    if (!split) return is_any_removed;
    if (split->smaller.size() > 1 || split->larger.size() < kMinOthers) {
      sensor.is_accepted = false;
      sensor.reasons.push_back("The pose of " + sensor.sensor + " differs between the scenes " +
                               names_of(split->larger, accepted, scenes) + " | " +
                               names_of(split->smaller, accepted, scenes) + " by " +
                               split_text(*split) +
                               ": it or the reference was moved between them, or some of the scans "
                               "are distorted.");
      sensor.advice.emplace_back(
          "If it was moved, calibrate the scenes before and after the move separately.");
      return is_any_removed;
    }
    const std::size_t outlier = split->smaller.front();
    exclude(sensor, accepted[outlier].scene, split_text(*split));
    accepted.erase(accepted.begin() + static_cast<std::ptrdiff_t>(outlier));
    is_any_removed = true;
  }
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
             apart_text(apart) + " apart, and no majority of the scenes agrees.";
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
  std::vector<AcceptedScene> accepted;
  for (const SceneResult& scene : scenes) {
    if (scene.result != nullptr && scene.result->is_accepted()) {
      accepted.push_back({sensor.scenes.size(), scene.result});
    }
    sensor.scenes.push_back(scene_estimate(scene));
  }
  if (accepted.empty()) {
    set_guess(sensor, scenes);
    set_reasons(sensor, scenes);
    return sensor;
  }
  sensor.is_accepted = remove_far(sensor, accepted);
  if (!sensor.is_accepted) {
    set_common_pose(sensor, accepted, false);
    sensor.reasons.push_back(disagreement(scenes));
    sensor.advice.emplace_back(
        "Check that all scenes are of the same rig, or record more scenes at different places.");
    return sensor;
  }
  const bool is_any_removed = test_agreement(sensor, accepted, scenes);
  set_common_pose(sensor, accepted, is_any_removed);
  reject_if_uncertain(sensor);
  return sensor;
}

}  // namespace croon

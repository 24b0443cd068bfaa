#include "framework/calibration/error_budget.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>

namespace croon {
namespace {

using Scenes = std::set<std::string>;
/// The results of one sensor, by scene.
using ByScene = std::map<std::string, const MemberResult*>;

/// The scans of a sensor in `scenes`, compared with the reference, or with another sensor.
std::vector<ComparedScan> scans_in(const Scenes& scenes, const ByScene& results,
                                   const ByScene* others) {
  std::vector<ComparedScan> scans;
  for (const auto& [scene, result] : results) {
    if (scenes.count(scene) == 0) continue;
    const Cloud* const source = &*result->estimate.source;
    if (others == nullptr) {
      scans.push_back({&*result->estimate.target, source, result->T_in_scene});
    } else if (const auto other = others->find(scene); other != others->end()) {
      scans.push_back({&*other->second->estimate.source, source,
                       other->second->T_in_scene.inverse() * result->T_in_scene});
    }
  }
  return scans;
}

/// The budgets of the sensors of a rig.
class Budgets {
 public:
  Budgets(CalibratedRig& rig, const std::vector<CalibrationMember>& members,
          const std::vector<MemberResult>& results)
      : rig_(rig) {
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (results[i].has_pose) results_[members[i].sensor][members[i].scene] = &results[i];
    }
  }

  void add() {
    for (bool is_any_new = true; is_any_new;) {
      is_any_new = false;
      for (CalibratedSensor& sensor : rig_.sensors) {
        if (sensor.error_budget || !sensor.covariance) continue;
        sensor.error_budget = budget_in(used_scenes(sensor), sensor);
        is_any_new = is_any_new || sensor.error_budget.has_value();
      }
    }
    for (CalibratedSensor& sensor : rig_.sensors) {
      if (sensor.error_budget) sensor.covariance->matrix += *sensor.error_budget;
      const Scenes used = used_scenes(sensor);
      for (SceneEstimate& scene : sensor.scenes) {
        const Scenes alone = {scene.scene};
        if (scene.covariance) {
          scene.error_budget = alone == used ? sensor.error_budget : budget_in(alone, sensor);
        }
        if (scene.error_budget) scene.covariance->matrix += *scene.error_budget;
      }
    }
  }

 private:
  /// The scenes that determine the pose of `sensor`: those in which it is accepted, or all.
  static Scenes used_scenes(const CalibratedSensor& sensor) {
    Scenes used, all;
    for (const SceneEstimate& scene : sensor.scenes) {
      all.insert(scene.scene);
      if (scene.reason.empty()) used.insert(scene.scene);
    }
    return used.empty() ? all : used;
  }

  /// The budget of a pose in `scenes`: from the surfaces in common with the reference, or without
  /// such, by way of the accepted sensor that makes it least.
  std::optional<Matrix6d> budget_in(const Scenes& scenes, const CalibratedSensor& sensor) const {
    const auto results = results_.find(sensor.sensor);
    if (results == results_.end()) return std::nullopt;
    std::optional<Matrix6d> least =
        covariance_of_beam_errors(scans_in(scenes, results->second, nullptr), kRealBeamErrors);
    if (least) return least;
    for (const CalibratedSensor& other : rig_.sensors) {
      if (&other == &sensor || !other.is_accepted || !other.error_budget) continue;
      const std::vector<ComparedScan> scans =
          scans_in(scenes, results->second, &results_.at(other.sensor));
      const auto of_pair = covariance_of_beam_errors(scans, kRealBeamErrors);
      if (!of_pair) continue;
      const PoseCovariance sum =
          composed_covariance(*other.T_reference_sensor, {*other.error_budget, {}},
                              scans.front().T_target_source, {*of_pair, {}});
      if (!least || sum.matrix.trace() < least->trace()) least = sum.matrix;
    }
    return least;
  }

  CalibratedRig& rig_;
  std::map<std::string, ByScene> results_;
};

}  // namespace

void add_error_budget(CalibratedRig& rig, const std::vector<CalibrationMember>& members,
                      const std::vector<MemberResult>& results) {
  Budgets(rig, members, results).add();
}

}  // namespace croon

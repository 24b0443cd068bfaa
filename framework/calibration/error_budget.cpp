#include "framework/calibration/error_budget.hpp"

#include <optional>

namespace croon {
namespace {

/// Adds the budget of a pose that `scans` determine, if it has a covariance.
void add_budget(const std::vector<ComparedScan>& scans, std::optional<PoseCovariance>& covariance,
                std::optional<Matrix6d>& budget) {
  if (!covariance || scans.empty()) return;
  budget = covariance_of_beam_errors(scans, kRealBeamErrors);
  covariance->matrix += *budget;
}

}  // namespace

void add_error_budget(CalibratedRig& rig, const std::vector<CalibrationMember>& members,
                      const std::vector<MemberResult>& results) {
  for (CalibratedSensor& sensor : rig.sensors) {
    std::vector<ComparedScan> used, all;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const MemberResult& result = results[i];
      if (members[i].sensor != sensor.sensor || !result.has_pose) continue;
      const ComparedScan scan = {&*result.estimate.target, &*result.estimate.source,
                                 result.T_in_scene};
      all.push_back(scan);
      for (SceneEstimate& scene : sensor.scenes) {
        if (scene.scene != members[i].scene) continue;
        add_budget({scan}, scene.covariance, scene.error_budget);
        if (scene.reason.empty()) used.push_back(scan);
      }
    }
    add_budget(used.empty() ? all : used, sensor.covariance, sensor.error_budget);
  }
}

}  // namespace croon

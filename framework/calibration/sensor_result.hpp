#pragma once

#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/rig_run.hpp"

namespace croon {

/// One sensor in one scene: how it ended, or why it took no part.
struct SceneResult {
  std::string scene;
  const MemberResult* result = nullptr;
  std::string why_not;  ///< If there is no result.
};

/// The result for `sensor` from its scenes. It is accepted if it is in at least one scene, and if
/// most of the scenes that accept a pose agree on it; else it has the best guess, the reasons and
/// what would help.
CalibratedSensor sensor_result(const std::string& sensor, const std::vector<SceneResult>& scenes);

}  // namespace croon

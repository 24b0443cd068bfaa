#pragma once

#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/rig_run.hpp"

namespace croon {

/// One sensor in one scene: its result, or why it was not used.
struct SceneResult {
  std::string scene;
  const MemberResult* result = nullptr;
  std::string why_not;  ///< Set if there is no result.
};

/// The result for `sensor` from its scenes. It is accepted if at least one scene accepts a pose,
/// the majority of these scenes agree on it, and it does not differ significantly between groups of
/// them (split_of_scenes); otherwise it has the best guess, reasons and advice. Single scenes that
/// differ from all others are not used.
CalibratedSensor sensor_result(const std::string& sensor, const std::vector<SceneResult>& scenes);

}  // namespace croon

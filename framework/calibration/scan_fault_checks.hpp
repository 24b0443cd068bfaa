#pragma once

#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/rig_run.hpp"

namespace croon {

/// Rejects the accepted sensors of `rig` whose ranges differ from those of the reference, or whose
/// scans consist of two halves that are shifted against each other: no pose is right for them. If
/// the ranges of all sensors differ from those of the reference by the same amount, the reason
/// names the reference. `results` are those of `members`.
void reject_scan_faults(CalibratedRig& rig, const std::vector<CalibrationMember>& members,
                        const std::vector<MemberResult>& results);

}  // namespace croon

#pragma once

#include <vector>

#include "framework/base/angles.hpp"
#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/rig_run.hpp"
#include "framework/registration/beam_errors.hpp"

namespace croon {

/// The systematic errors of LiDARs, from data sheets, not fitted to any recording: ranges within 2
/// cm (Hesai Pandar64) to 3 cm (Livox HAP, "distance system error"), angles within 0.1° (Livox HAP,
/// also the last digit of nominal angles of channels).
inline constexpr BeamErrors kRealBeamErrors = {rad_from_deg(0.1), rad_from_deg(0.1), 0.02};

/// Adds what kRealBeamErrors do to the poses to the covariances of `rig`, of the sensors and of
/// their scenes: no scatter of the data shows errors that all points of a sensor share. `results`
/// are those of `members`.
void add_error_budget(CalibratedRig& rig, const std::vector<CalibrationMember>& members,
                      const std::vector<MemberResult>& results);

}  // namespace croon

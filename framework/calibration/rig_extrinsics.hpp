#pragma once

#include <string>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/extrinsics.hpp"

namespace croon {

/// The poses of a calibrated rig in the frame of its reference, including best guesses.
Extrinsics extrinsics_of(const CalibratedRig& rig);

/// The text of extrinsics.json with all results of a calibration. Angles are in degrees and lengths
/// in metres, except in covariances, which have the units of PoseCovariance.
std::string rig_extrinsics_json(const CalibratedRig& rig);

}  // namespace croon

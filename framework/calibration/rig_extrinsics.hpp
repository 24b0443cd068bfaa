#pragma once

#include <string>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/extrinsics.hpp"

namespace croon {

/// The poses of a calibrated rig in the frame of its reference, best guesses included.
Extrinsics extrinsics_of(const CalibratedRig& rig);

/// extrinsics.json: everything that a calibration found. Angles are in degrees and lengths in
/// metres, but for the covariances, which are those of PoseCovariance.
std::string rig_extrinsics_json(const CalibratedRig& rig);

}  // namespace croon

#pragma once

#include <string>

#include "framework/calibration/calibrated_rig.hpp"

namespace croon {

/// A sentence that suggests another reference: if a sensor was rejected because its common view
/// with the reference is too small, and another sensor has a much larger field of view than the
/// reference. Otherwise empty, also if the sensor was already compared with the other one.
std::string reference_hint(const CalibratedRig& rig);

}  // namespace croon

#pragma once

#include <string>

#include "framework/calibration/calibrated_rig.hpp"

namespace croon::experiments {

/// The result of a calibration for a terminal: for each sensor the verdict first, then its pose,
/// standard deviations and distance from the nominal pose, or the reasons for which it was
/// rejected, what would help, and the best guess; then warnings, what took no part, and the
/// reference's pose over the ground. With `colours`, verdicts have colours.
std::string calibration_text(const CalibratedRig& rig, bool colours);

}  // namespace croon::experiments

#pragma once

#include <string>

#include "framework/calibration/calibrated_rig.hpp"

namespace croon::experiments {

/// The result of a calibration for a terminal: for each sensor the verdict, then its pose, standard
/// deviations and distance from the nominal pose, or the reasons for rejection, advice, and the
/// best guess; then warnings, unused inputs, and the pose of the reference above the ground. With
/// `colours`, verdicts are coloured.
std::string calibration_text(const CalibratedRig& rig, bool colours);

}  // namespace croon::experiments

#pragma once

#include <string>
#include <vector>

#include "framework/calibration/calibrated_rig.hpp"
#include "framework/calibration/rig_pictures.hpp"
#include "framework/document/document.hpp"

namespace croon::experiments {

/// The verdict on every sensor with its pose, the motion of the rig, its ground plane and the
/// warnings.
Section verdict_section(const CalibratedRig& rig);

/// "3 of 4 sensors accepted, but the clouds contradict the pose of left".
std::string accepted_sentence(const CalibratedRig& rig);

/// What `croon calibrate` prints; verdicts in colour if `colours`.
std::string calibration_text(const CalibratedRig& rig, bool colours);

/// The report of a calibration: the verdicts, and the views, numbers and pictures from which to
/// judge them. A sensor whose clouds contradict its accepted pose has a warning. `provenance` is
/// the origin of the result: the version, the command.
Document calibration_report(const CalibratedRig& rig, const std::vector<RigPicture>& pictures,
                            const Facts& provenance);

}  // namespace croon::experiments

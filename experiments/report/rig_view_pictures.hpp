#pragma once

#include "framework/calibration/rig_view.hpp"
#include "framework/document/document.hpp"

namespace croon::experiments {

/// The clouds within 25 m from above, at the first and the last state.
Picture overview_picture(const RigView& view);

/// The close-up from above, at the first and the last state.
Picture close_up_picture(const RigView& view, const CloseUp& place);

}  // namespace croon::experiments

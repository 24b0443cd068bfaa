#pragma once

#include "framework/calibration/rig_view.hpp"
#include "framework/document/document.hpp"

namespace croon::experiments {

/// The clouds within 25 m from above, at the first and the last state.
Picture overview_picture(const RigView& view);

/// The close-ups of the view from above, each at the first and the last state.
FigureRow close_up_row(const RigView& view);

}  // namespace croon::experiments

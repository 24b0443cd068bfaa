#pragma once

#include <string>

#include "framework/calibration/rig_view.hpp"
#include "framework/document/document.hpp"

namespace croon::experiments {

/// The clouds, poses and distances of a view as JSON for framework/document/assets/cloud_view.js.
/// Coordinates are quantised to 16 bits, distances to 2 mm.
std::string rig_view_json(const RigView& view);

/// The interactive view; its fallback shows the clouds within 25 m from above, at the first and the
/// last state.
CloudViewBlock cloud_view_block(const RigView& view, const std::string& caption);

/// The close-ups of the view from above, each at the first and the last state.
FigureRow close_up_row(const RigView& view);

}  // namespace croon::experiments

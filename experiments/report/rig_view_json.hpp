#pragma once

#include <string>

#include "framework/calibration/rig_view.hpp"

namespace croon::experiments {

/// The clouds, poses and distances of a view as JSON for framework/document/assets/cloud_view.js.
/// Coordinates are quantised to 16 bits, distances to 2 mm.
std::string rig_view_json(const RigView& view);

}  // namespace croon::experiments

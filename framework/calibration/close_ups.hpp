#pragma once

#include <vector>

#include "framework/calibration/rig_view.hpp"

namespace croon {

/// A wall, a vertical edge and a pole, of each the farthest that two sensors measured: places where
/// a misalignment would show. Kinds that the scene lacks are omitted.
std::vector<CloseUp> close_ups(const RigView& view);

}  // namespace croon

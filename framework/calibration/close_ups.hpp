#pragma once

#include <vector>

#include "framework/calibration/rig_view.hpp"

namespace croon {

/// Places where a misalignment would show: the farthest wall, the farthest vertical edge and the
/// farthest pole that two sensors measured. Kinds that the scene lacks are omitted.
std::vector<CloseUp> close_ups(const RigView& view);

}  // namespace croon

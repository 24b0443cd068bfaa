#pragma once

#include <vector>

#include "experiments/report/scene_summary.hpp"

namespace croon::experiments {

/// The loops of each variant and pair, over all scenes: trial i of the pair, of its source and of
/// its target make one. A loop whose three trials are not all in `groups` is none.
std::vector<LoopClosure> close_loops(const RecordGroups& groups, const ReportOrder& order,
                                     const PoseBounds& bounds);

}  // namespace croon::experiments

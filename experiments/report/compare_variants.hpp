#pragma once

#include <string>
#include <vector>

#include "experiments/report/scene_summary.hpp"

namespace croon::experiments {

/// Every variant against `base`, the first of the experiment, over the trials that both have: by
/// variant, then sensor as in `rows`, then all sensors together. `groups` are the records of
/// `rows`. Where they share no trials there is no comparison. p values are corrected over the
/// three tests of all variants with the same sensor.
std::vector<Comparison> compare_with_base(const std::string& base, const RecordGroups& groups,
                                          const std::vector<SummaryRow>& rows,
                                          const SuccessBounds& bounds);

}  // namespace croon::experiments

#pragma once

#include <vector>

#include "experiments/report/summary.hpp"

namespace croon::experiments {

/// What the scenes of each kind came to, by variant, kind (alphabetically; scenes without one have
/// the kind "") and sensor as in `rows`, all sensors together last. Nothing where no scene has a
/// kind.
std::vector<KindSummary> summarise_kinds(const std::vector<SummaryRow>& rows);

}  // namespace croon::experiments

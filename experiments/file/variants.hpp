#pragma once

#include <vector>

#include "experiments/file/experiment.hpp"
#include "framework/stage/catalogue.hpp"

namespace croon::experiments {

/// The base pipeline of the experiment `root` and its variants, each multiplied out over the grid:
/// the base first, then in the order of the file. A point of the grid is called
/// `variant/point/point`, a point in each axis. Faults are noted in `faults`, at their places in
/// the file; one that variants share is noted for each of them.
std::vector<Variant> read_variants(const params::Node& root, const Catalogue& catalogue,
                                   std::vector<Fault>& faults);

}  // namespace croon::experiments

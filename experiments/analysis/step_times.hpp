#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "experiments/store/timings_store.hpp"

namespace croon::experiments {

/// The wall time of one step of a variant.
struct StepTime {
  std::string variant;
  std::string step;
  double median_s = 0.0;  ///< Over the trials that ran the step.
};

/// The times of the trials in `summary`, by variant in its order, then in the order of the steps.
/// Work that is done once per scene is not included.
std::vector<StepTime> step_times(const TimingsStore& timings, const Summary& summary);

}  // namespace croon::experiments

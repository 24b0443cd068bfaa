#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "experiments/store/store.hpp"

namespace croon::experiments {

/// A number reported by a step of a variant, summarised over all trials.
struct DiagnosticSummary {
  std::string variant;
  std::string step;
  std::string name;              ///< "inlier_ratio".
  int trials = 0;                ///< Number of trials that reported it.
  std::optional<double> median;  ///< Median of the finite values, if there are any.
};

/// Summarises the numbers of `steps`, the steps of `records`: by variant, then in the order in
/// which steps first report them.
std::vector<DiagnosticSummary> summarise_diagnostics(const std::vector<TrialRecord>& records,
                                                     const StepNumbers& steps);

}  // namespace croon::experiments

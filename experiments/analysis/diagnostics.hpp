#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "experiments/store/store.hpp"

namespace croon::experiments {

/// One number that the steps of a variant report, over all its trials.
struct DiagnosticSummary {
  std::string variant;
  std::string step;
  std::string name;              ///< "inlier_ratio".
  int trials = 0;                ///< That reported it.
  std::optional<double> median;  ///< Of the finite values; nothing if there is none.
};

/// The numbers of `steps`, which are of `records`: by variant, then in the order in which steps
/// first report them.
std::vector<DiagnosticSummary> summarise_diagnostics(const std::vector<TrialRecord>& records,
                                                     const StepNumbers& steps);

}  // namespace croon::experiments

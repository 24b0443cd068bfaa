#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"

namespace croon::experiments {

/// The numbers of accepted and rejected trials with right poses (within a threshold of ground
/// truth) and wrong poses.
struct AcceptanceCounts {
  int accepted_right = 0;
  int accepted_wrong = 0;
  int rejected_right = 0;
  int rejected_wrong = 0;
  int failed = 0;  ///< Trials without a pose.

  int trials() const {
    return accepted_right + accepted_wrong + rejected_right + rejected_wrong + failed;
  }
};

/// The counts of the trials of one variant and sensor.
struct AcceptanceRow {
  std::string variant;
  std::string sensor;  ///< Empty for all sensors together.
  AcceptanceCounts at_bounds;
  std::vector<AcceptanceCounts> at_thresholds;  ///< By AcceptanceCurve::thresholds.
};

/// The verdicts of the program compared with ground truth: at the success bounds, and as a function
/// of the threshold above which a pose is wrong.
struct AcceptanceCurve {
  std::vector<SuccessBounds> thresholds;  ///< Those of the success curve.
  std::vector<AcceptanceRow> rows;        ///< By variant, then sensor (all sensors together last);
                                          ///< none if no trial with ground truth was rejected.
};

/// Whether there are counts over thresholds; false if no trial with ground truth was rejected, or
/// if a success bound is zero.
inline bool has_curve(const AcceptanceCurve& acceptance) {
  return !acceptance.rows.empty() && !acceptance.thresholds.empty();
}

/// Counts the verdicts on `records`, whose summary is `summary`.
AcceptanceCurve acceptance_of(const std::vector<TrialRecord>& records, const Summary& summary);

}  // namespace croon::experiments

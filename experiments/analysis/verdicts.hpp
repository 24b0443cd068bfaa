#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"

namespace croon::experiments {

/// How many trials the program accepted and rejected, of poses that are right (within a threshold
/// of the truth) and wrong.
struct VerdictCounts {
  int accepted_right = 0;
  int accepted_wrong = 0;
  int rejected_right = 0;
  int rejected_wrong = 0;
  int failed = 0;  ///< Without a pose.

  int trials() const {
    return accepted_right + accepted_wrong + rejected_right + rejected_wrong + failed;
  }
};

/// The verdicts on the trials of one variant and sensor.
struct VerdictRow {
  std::string variant;
  std::string sensor;  ///< Empty for all together.
  VerdictCounts at_bounds;
  std::vector<VerdictCounts> at_thresholds;  ///< As Verdicts::thresholds.
};

/// The program's verdicts against the truth: at the success bounds, and over the threshold from
/// which on a pose is wrong.
struct Verdicts {
  std::vector<SuccessBounds> thresholds;  ///< Those of the success curve.
  std::vector<VerdictRow> rows;  ///< By variant, then sensor, all together last; none if no trial
                                 ///< with truth was rejected.
};

/// Whether there are verdicts over thresholds: not if no trial was rejected, nor with a success
/// bound of zero.
inline bool has_curve(const Verdicts& verdicts) {
  return !verdicts.rows.empty() && !verdicts.thresholds.empty();
}

/// The verdicts on `records`, whose summary is `summary`.
Verdicts verdicts_of(const std::vector<TrialRecord>& records, const Summary& summary);

}  // namespace croon::experiments

#pragma once

#include <string>
#include <vector>

#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

/// The bytes of trials.csv: a header and a row per record in the order given. Error columns are
/// empty where there is no truth, pose columns where the trial did not finish; quaternions have qw
/// >= 0.
std::string trials_csv(const std::vector<TrialRecord>& records);

/// The bytes of timings.csv: a header and a row per timing in the order given.
std::string timings_csv(const std::vector<TimingRow>& rows);

}  // namespace croon::experiments

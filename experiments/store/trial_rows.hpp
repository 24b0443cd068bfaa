#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "experiments/store/database.hpp"

namespace croon::experiments {

/// The key of a trial in the store: the ids of its variant, scene and sensor, and its number.
struct TrialRow {
  std::int64_t variant = 0;
  std::int64_t scene = 0;
  std::int64_t sensor = 0;
  int trial = 0;
};

/// Adds rows to a store.
class RecordInserter {
 public:
  explicit RecordInserter(const Database& database);
  /// Adds `record`, its covariance and its steps as the trial `row`.
  void add(const TrialRow& row, const TrialRecord& record);

 private:
  Statement trial_;
  Statement covariance_;
  Statement step_;
};

/// The statement whose rows `row_of` and `result_of` read.
Statement select_results(const Database& database);
TrialRow row_of(const Statement& select);
/// The result, without its id.
TrialRecord result_of(const Statement& select);

/// The statement whose rows `row_of` and `stored_covariance_of` read, in the order of the store.
Statement select_covariances(const Database& database);
PoseCovariance stored_covariance_of(const Statement& select);

/// The statement whose rows `row_of` and `diagnostics_of` read, in the order of the store.
Statement select_diagnostics(const Database& database);
/// The name of the step and the diagnostics that it reported. Throws std::exception if they are
/// damaged.
std::pair<std::string, std::vector<Diagnostic>> diagnostics_of(const Statement& select);

}  // namespace croon::experiments

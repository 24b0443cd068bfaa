#include "experiments/analysis/verdicts.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "experiments/run/trial_end.hpp"

namespace croon::experiments {
namespace {

void add(VerdictCounts& counts, const TrialRecord& record, const SuccessBounds& threshold) {
  if (!record.error) {
    ++counts.failed;
    return;
  }
  const bool is_right = is_within(*record.error, threshold);
  if (record.status == Status::rejected) {
    ++(is_right ? counts.rejected_right : counts.rejected_wrong);
  } else {
    ++(is_right ? counts.accepted_right : counts.accepted_wrong);
  }
}

void add(VerdictRow& row, const TrialRecord& record, const SuccessBounds& bounds,
         const std::vector<SuccessBounds>& thresholds) {
  add(row.at_bounds, record, bounds);
  row.at_thresholds.resize(thresholds.size());
  for (std::size_t i = 0; i < thresholds.size(); ++i) {
    add(row.at_thresholds[i], record, thresholds[i]);
  }
}

/// Whether the truth of the trial's sensor is known; that of a trial without a pose is not asked
/// for.
bool is_judged(const TrialRecord& record) {
  return record.error || record.status == Status::failed;
}

}  // namespace

Verdicts verdicts_of(const std::vector<TrialRecord>& records, const Summary& summary) {
  Verdicts verdicts{summary.curve.thresholds, {}};
  const bool has_rejected = std::any_of(
      records.begin(), records.end(),
      [](const TrialRecord& record) { return record.status == Status::rejected && record.error; });
  if (!has_rejected) return verdicts;
  std::map<std::pair<std::string, std::string>, VerdictRow> rows;
  for (const TrialRecord& record : records) {
    if (!is_judged(record)) continue;
    for (const std::string& sensor : {record.id.sensor, std::string()}) {
      add(rows[{record.id.variant, sensor}], record, summary.bounds, verdicts.thresholds);
    }
  }
  std::vector<std::string> sensors = sensors_of(summary);
  sensors.emplace_back();
  for (const std::string& variant : variants_of(summary)) {
    for (const std::string& sensor : sensors) {
      const auto found = rows.find({variant, sensor});
      if (found == rows.end()) continue;
      found->second.variant = variant;
      found->second.sensor = sensor;
      verdicts.rows.push_back(std::move(found->second));
    }
  }
  return verdicts;
}

}  // namespace croon::experiments

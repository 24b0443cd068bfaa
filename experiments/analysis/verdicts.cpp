#include "experiments/analysis/verdicts.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "experiments/run/trial_end.hpp"

namespace croon::experiments {
namespace {

AcceptanceCounts& operator+=(AcceptanceCounts& sum, const AcceptanceCounts& other) {
  sum.accepted_right += other.accepted_right;
  sum.accepted_wrong += other.accepted_wrong;
  sum.rejected_right += other.rejected_right;
  sum.rejected_wrong += other.rejected_wrong;
  sum.failed += other.failed;
  return sum;
}

void add(AcceptanceCounts& counts, const TrialRecord& record, const SuccessBounds& threshold) {
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

void add(AcceptanceRow& row, const TrialRecord& record, const SuccessBounds& bounds,
         const std::vector<SuccessBounds>& thresholds) {
  add(row.at_bounds, record, bounds);
  row.at_thresholds.resize(thresholds.size());
  for (std::size_t i = 0; i < thresholds.size(); ++i) {
    add(row.at_thresholds[i], record, thresholds[i]);
  }
}

/// Sensors and scenes without ground truth.
using WithoutTruth = std::set<std::pair<std::string, std::string>>;

WithoutTruth without_truth(const Summary& summary) {
  WithoutTruth without;
  for (const SummaryRow& row : summary.rows) {
    for (const SceneSummary& scene : row.scenes) {
      if (lacks_truth(scene)) without.insert({row.sensor, scene.scene});
    }
  }
  return without;
}

}  // namespace

AcceptanceCurve acceptance_of(const std::vector<TrialRecord>& records, const Summary& summary) {
  AcceptanceCurve acceptance{summary.curve.thresholds, {}};
  const bool has_rejected = std::any_of(
      records.begin(), records.end(),
      [](const TrialRecord& record) { return record.status == Status::rejected && record.error; });
  if (!has_rejected) return acceptance;
  const WithoutTruth without = without_truth(summary);
  std::map<std::pair<std::string, std::string>, AcceptanceRow> rows;
  for (const TrialRecord& record : records) {
    // A trial without a pose has no error, with or without ground truth.
    const bool is_judged = record.error || record.status == Status::failed;
    if (!is_judged || without.count({record.id.sensor, record.id.scene}) > 0) continue;
    add(rows[{record.id.variant, record.id.sensor}], record, summary.bounds, acceptance.thresholds);
  }
  for (const std::string& variant : variants_of(summary)) {
    AcceptanceRow all{variant, "", {}, std::vector<AcceptanceCounts>(acceptance.thresholds.size())};
    for (const std::string& sensor : sensors_of(summary)) {
      const auto found = rows.find({variant, sensor});
      if (found == rows.end()) continue;
      AcceptanceRow& row = found->second;
      row.variant = variant;
      row.sensor = sensor;
      all.at_bounds += row.at_bounds;
      for (std::size_t i = 0; i < all.at_thresholds.size(); ++i) {
        all.at_thresholds[i] += row.at_thresholds[i];
      }
      acceptance.rows.push_back(std::move(row));
    }
    if (all.at_bounds.trials() > 0) acceptance.rows.push_back(std::move(all));
  }
  return acceptance;
}

}  // namespace croon::experiments

#include "experiments/analysis/claims.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace croon::experiments {
namespace {

std::optional<double> percent_of(int count, int trials) {
  if (trials == 0) return std::nullopt;
  return 100.0 * count / trials;
}

std::optional<double> successful_trials(const Rows& rows) {
  int count = 0;
  int trials = 0;
  for (const SummaryRow* row : rows) {
    count += main_share(*row).count;
    trials += main_share(*row).trials;
  }
  return percent_of(count, trials);
}

/// A scene counts if every trial of each of its sensors succeeds.
std::optional<double> successful_scenes(const Rows& rows) {
  std::set<std::string> all;
  std::set<std::string> without_success;
  for (const SceneSummary* scene : scenes_of(rows)) {
    const Share& share = main_share(*scene);
    all.insert(scene->scene);
    if (share.count < share.trials) without_success.insert(scene->scene);
  }
  return percent_of(static_cast<int>(all.size() - without_success.size()),
                    static_cast<int>(all.size()));
}

/// Whether the deviations of all rows are errors.
bool have_truth(const Rows& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const SummaryRow* row) {
    return row->deviations_from == DeviationsFrom::truth;
  });
}

/// The spread of all rows together: variances weighted by their degrees of freedom.
std::optional<DofValues> pooled_spread(const Rows& rows,
                                       std::optional<DofValues> SummaryRow::*spread,
                                       double SummaryRow::*freedom_of) {
  double freedom = 0.0;
  DofValues pooled = {};
  for (const SummaryRow* row : rows) {
    if (!(row->*spread)) continue;
    const double weight = row->*freedom_of;
    freedom += weight;
    for (std::size_t k = 0; k < kDofs; ++k) pooled[k] += weight * std::pow((*(row->*spread))[k], 2);
  }
  if (freedom == 0.0) return std::nullopt;
  for (double& value : pooled) value = std::sqrt(value / freedom);
  return pooled;
}

/// The spread of a DOF, or for `rotation` and `translation` that of their three DOFs together.
double spread_of(const DofValues& spread, std::size_t measure) {
  if (measure < kDofs) return spread[measure];
  const std::size_t first = measure == kRotation ? 0 : 3;
  return std::hypot(spread[first], spread[first + 1], spread[first + 2]);
}

std::optional<double> found(const Claim& claim, const Summary& summary) {
  const Rows rows = rows_of(summary, claim.variant, claim.sensor);
  if (claim.statistic == kSuccess) return successful_trials(rows);
  if (claim.statistic == kScenes) return successful_scenes(rows);
  const std::size_t measure = measure_index(claim.measure);
  const bool is_within = claim.statistic == kWithinSceneStd;
  if (is_within || claim.statistic == kAcrossScenesStd) {
    const auto spread = is_within ? pooled_spread(rows, &SummaryRow::within_scene_std,
                                                  &SummaryRow::within_scene_freedom)
                                  : pooled_spread(rows, &SummaryRow::across_scenes_std,
                                                  &SummaryRow::across_scenes_freedom);
    if (!spread) return std::nullopt;
    return spread_of(*spread, measure);
  }
  const std::size_t statistic = statistic_index(claim.statistic);
  if (kStatistics[statistic].needs_truth && !have_truth(rows)) return std::nullopt;
  return value_of(pooled(scenes_of(rows)).statistics, measure, statistic);
}

Verdict verdict_of(const Claim& claim, const std::optional<double>& found) {
  if (!found) return Verdict::not_measured;
  const bool is_in = *found >= claim.band.front() && *found <= claim.band.back();
  return is_in ? Verdict::in : Verdict::out;
}

}  // namespace

std::vector<ClaimResult> check_claims(const std::vector<Claim>& claims, const Summary& summary) {
  std::vector<ClaimResult> results;
  for (const Claim& claim : claims) {
    const std::optional<double> value = found(claim, summary);
    results.push_back({claim, value, verdict_of(claim, value)});
  }
  return results;
}

const char* verdict_name(Verdict verdict) {
  return std::array{"in", "out", "not measured"}.at(static_cast<std::size_t>(verdict));
}

const char* unit_of(const Claim& claim) {
  if (is_share(claim.statistic)) return "%";
  return kMeasures[measure_index(claim.measure)].unit;
}

std::optional<DofValues> row_beside(const Quoted& quoted, const Summary& summary) {
  if (summary.rows.empty()) return std::nullopt;
  const Rows rows = rows_of(summary, summary.rows.front().variant);
  const std::optional<StatisticsTable> statistics = pooled(scenes_of(rows)).statistics;
  if (!statistics || !have_truth(rows)) return std::nullopt;
  DofValues row;
  for (std::size_t k = 0; k < kDofs; ++k) {
    row[k] = (*statistics)[k][statistic_index(quoted.statistic)];
  }
  return row;
}

}  // namespace croon::experiments

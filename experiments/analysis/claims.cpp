#include "experiments/analysis/claims.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace croon::experiments {

namespace {

using Rows = std::vector<const SummaryRow*>;

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
  std::map<std::string, bool> succeeds;
  for (const SceneSummary* scene : scenes_of(rows)) {
    const Share& share = main_share(*scene);
    bool& all = succeeds.emplace(scene->scene, true).first->second;
    all = all && share.count == share.trials;
  }
  const auto count = std::count_if(succeeds.begin(), succeeds.end(),
                                   [](const auto& scene) { return scene.second; });
  return percent_of(static_cast<int>(count), static_cast<int>(succeeds.size()));
}

/// Whether the deviations of all rows are errors.
bool have_truth(const Rows& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const SummaryRow* row) {
    return row->deviations_from == DeviationsFrom::truth;
  });
}

double trials_beyond_one(const SummaryRow& row) {
  double freedom = 0.0;
  for (const SceneSummary& scene : row.scenes) freedom += std::max(0, scene.counted - 1);
  return freedom;
}

double scenes_beyond_one(const SummaryRow& row) {
  const auto counted = std::count_if(row.scenes.begin(), row.scenes.end(),
                                     [](const SceneSummary& scene) { return scene.counted > 0; });
  return static_cast<double>(counted) - 1.0;
}

/// The spread of all rows together: variances weighted by their degrees of freedom.
std::optional<DofValues> pooled_spread(const Rows& rows,
                                       std::optional<DofValues> SummaryRow::*spread,
                                       double (*freedom_of)(const SummaryRow&)) {
  double freedom = 0.0;
  DofValues pooled = {};
  for (const SummaryRow* row : rows) {
    if (!(row->*spread)) continue;
    const double weight = freedom_of(*row);
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
    const auto spread =
        is_within ? pooled_spread(rows, &SummaryRow::within_scene_std, trials_beyond_one)
                  : pooled_spread(rows, &SummaryRow::across_scenes_std, scenes_beyond_one);
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
  switch (verdict) {
    case Verdict::in:
      return "in";
    case Verdict::out:
      return "out";
    case Verdict::not_measured:
      return "not measured";
  }
  throw std::logic_error("a verdict that does not exist");
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

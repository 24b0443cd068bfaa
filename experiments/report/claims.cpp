#include "experiments/report/claims.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "experiments/report/row_table.hpp"
#include "experiments/report/scene_summary.hpp"
#include "experiments/report/statistic_names.hpp"

namespace croon::experiments {

namespace {

using Rows = std::vector<const SummaryRow*>;
using Spread = std::array<double, kDofs>;

/// The rows of a variant, of all its sensors where `sensor` is empty.
Rows rows_of(const Summary& summary, const std::string& variant, const std::string& sensor) {
  Rows rows;
  for (const SummaryRow& row : summary.rows) {
    if (row.variant == variant && (sensor.empty() || row.sensor == sensor)) rows.push_back(&row);
  }
  return rows;
}

std::size_t measure_index(const std::string& name) {
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    if (name == kMeasures[k].name) return k;
  }
  throw std::logic_error("no measure is called \"" + name + "\"");
}

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

/// A scene counts where every trial of each of its sensors succeeds.
std::optional<double> successful_scenes(const Rows& rows) {
  std::map<std::string, bool> succeeds;
  for (const SummaryRow* row : rows) {
    for (const SceneSummary& scene : row->scenes) {
      const Share& share = main_share(*row, scene);
      bool& all = succeeds.emplace(scene.scene, true).first->second;
      all = all && share.count == share.trials;
    }
  }
  const auto count = std::count_if(succeeds.begin(), succeeds.end(),
                                   [](const auto& scene) { return scene.second; });
  return percent_of(static_cast<int>(count), static_cast<int>(succeeds.size()));
}

/// Whether the deviations of all rows are errors. Without truth they are from what the trials
/// themselves agree on: their spread says something, their mean is zero whatever the method.
bool have_truth(const Rows& rows) {
  return std::all_of(rows.begin(), rows.end(),
                     [](const SummaryRow* row) { return row->reference == Reference::truth; });
}

/// The statistics of the trials that count, of all rows together.
std::optional<StatisticsTable> pooled_statistics(const Rows& rows) {
  if (rows.size() == 1) return rows.front()->statistics;
  std::vector<Measures> deviations;
  for (const SummaryRow* row : rows) {
    for (const SceneSummary& scene : row->scenes) {
      deviations.insert(deviations.end(), scene.deviations.begin(), scene.deviations.end());
    }
  }
  if (deviations.empty()) return std::nullopt;
  return statistics_of(deviations);
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
std::optional<Spread> pooled_spread(const Rows& rows, std::optional<Spread> SummaryRow::*spread,
                                    double (*freedom_of)(const SummaryRow&)) {
  double freedom = 0.0;
  Spread pooled = {};
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

/// Of a degree of freedom, or of the three that `rotation` and `translation` (6 and 7) hold.
double spread_of(const Spread& spread, std::size_t measure) {
  if (measure < kDofs) return spread[measure];
  const std::size_t first = measure == kDofs ? 0 : 3;
  return std::hypot(spread[first], spread[first + 1], spread[first + 2]);
}

double statistic_of(const MeasureStatistics& statistics, const std::string& name) {
  for (const Statistic& statistic : kStatistics) {
    if (name == statistic.name) return statistics.*statistic.value;
  }
  throw std::logic_error("no statistic is called \"" + name + "\"");
}

std::optional<double> found(const Claim& claim, const Summary& summary) {
  const Rows rows = rows_of(summary, claim.variant, claim.sensor);
  const std::string& name = claim.statistic;
  if (name == kSuccess) return successful_trials(rows);
  if (name == kScenes) return successful_scenes(rows);
  const std::size_t measure = measure_index(claim.measure);
  if (name == kWithinSceneStd || name == kAcrossScenesStd) {
    const auto spread =
        name == kWithinSceneStd
            ? pooled_spread(rows, &SummaryRow::within_scene_std, trials_beyond_one)
            : pooled_spread(rows, &SummaryRow::across_scenes_std, scenes_beyond_one);
    if (!spread) return std::nullopt;
    return spread_of(*spread, measure);
  }
  const std::optional<StatisticsTable> statistics = pooled_statistics(rows);
  if (!statistics || (name != "std" && !have_truth(rows))) return std::nullopt;
  const double value = statistic_of((*statistics)[measure], name);
  if (std::isnan(value)) return std::nullopt;
  return value;
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

std::optional<std::array<double, kDofs>> row_beside(const Quoted& quoted, const Summary& summary) {
  if (summary.rows.empty()) return std::nullopt;
  const Rows rows = rows_of(summary, summary.rows.front().variant, "");
  const auto statistics = pooled_statistics(rows);
  if (!statistics || !have_truth(rows)) return std::nullopt;
  std::array<double, kDofs> row;
  for (std::size_t k = 0; k < kDofs; ++k) row[k] = statistic_of((*statistics)[k], quoted.statistic);
  return row;
}

}  // namespace croon::experiments

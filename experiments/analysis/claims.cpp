#include "experiments/analysis/claims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace croon::experiments {
namespace {

std::optional<double> percent_of(int count, int trials) {
  if (trials == 0) return std::nullopt;
  return 100.0 * count / trials;
}

std::optional<double> percent_of(const Share& share) {
  return percent_of(share.count, share.trials);
}

/// Whether success is known for all rows, that is, all have ground truth.
bool have_success(const Rows& rows) {
  return std::none_of(rows.begin(), rows.end(),
                      [](const SummaryRow* row) { return lacks_truth(*row); });
}

bool is_spread(const Claim& claim) {
  return claim.statistic == kWithinSceneStd || claim.statistic == kAcrossScenesStd;
}

/// The pooled spread of all rows: variances weighted by their degrees of freedom.
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

/// The spread of a DOF; for `rotation` and `translation` the combined spread of their three DOFs.
double spread_of(const DofValues& spread, std::size_t measure) {
  if (measure < kDofs) return spread[measure];
  const std::size_t first = measure == kRotation ? 0 : 3;
  return std::hypot(spread[first], spread[first + 1], spread[first + 2]);
}

std::optional<double> found(const Claim& claim, const Rows& rows, const TrialSummary& all) {
  if (claim.statistic == kAgreement) return percent_of(all.agreement);
  if (is_share(claim.statistic)) {
    if (!have_success(rows)) return std::nullopt;
    return claim.statistic == kSuccess ? percent_of(all.success)
                                       : percent_of(successful_frames(rows));
  }
  const std::size_t measure = measure_index(claim.measure);
  if (is_spread(claim)) {
    const auto spread =
        claim.statistic == kWithinSceneStd
            ? pooled_spread(rows, &SummaryRow::within_scene_std, &SummaryRow::within_scene_freedom)
            : pooled_spread(rows, &SummaryRow::across_scenes_std,
                            &SummaryRow::across_scenes_freedom);
    if (!spread) return std::nullopt;
    return spread_of(*spread, measure);
  }
  const std::size_t statistic = statistic_index(claim.statistic);
  if (kStatistics[statistic].needs_truth && !have_truth(rows)) return std::nullopt;
  const auto& statistics = claim.over == Over::usable ? all.usable_statistics : all.statistics;
  return value_of(statistics, measure, statistic);
}

/// Sets the numbers of trials and scenes that a claim is computed over.
void set_counts(ClaimResult& result, const Rows& rows, const TrialSummary& all) {
  const bool is_over_usable = !is_spread(result.claim) && result.claim.over == Over::usable;
  const auto trials_of = [&](const SceneSummary& scene) {
    if (result.claim.statistic == "agreement") return scene.agreement.trials;
    if (is_share(result.claim.statistic)) return scene.outcomes.trials;
    // A single trial has no spread.
    if (result.claim.statistic == kWithinSceneStd && scene.counted < 2) return 0;
    return is_over_usable ? scene.usable : scene.counted;
  };
  std::set<std::string> scenes;
  for (const SceneSummary* scene : scenes_of(rows)) {
    if (!is_judged_as(all, *scene) || trials_of(*scene) == 0) continue;
    scenes.insert(scene->scene);
    result.trials += trials_of(*scene);
  }
  result.scenes = static_cast<int>(scenes.size());
}

/// The maximum std of values of magnitude up to 1, pooled over groups of these sizes: half of each
/// group's values are at either end. 1 if no group has two values.
double max_std(const std::vector<int>& groups) {
  double squares = 0.0, freedom = 0.0;
  for (const int n : groups) {
    if (n < 2) continue;
    squares += n % 2 == 0 ? n : n - 1.0 / n;
    freedom += n - 1;
  }
  return freedom > 0.0 ? std::sqrt(squares / freedom) : 1.0;
}

/// The numbers of values that the spread `statistic` is pooled over: trials per scene, or scenes
/// per sensor.
std::vector<int> spread_groups(const std::string& statistic, const Rows& rows) {
  std::vector<int> groups;
  for (const SummaryRow* row : rows) {
    int scenes = 0;
    for (const SceneSummary& scene : row->scenes) {
      if (statistic == kWithinSceneStd) groups.push_back(scene.counted);
      scenes += scene.counted > 0 ? 1 : 0;
    }
    if (statistic == kAcrossScenesStd) groups.push_back(scenes);
  }
  return groups;
}

/// The maximum magnitude of the measure of a counted trial.
double max_magnitude(const Claim& claim, const SuccessBounds& bounds, bool has_truth) {
  const std::size_t measure = measure_index(claim.measure);
  const bool is_angle = kMeasures[measure].unit == std::string("deg");
  if (has_truth && (is_spread(claim) || claim.over == Over::successful)) {
    return is_angle ? bounds.rotation_deg : bounds.translation_m;
  }
  constexpr auto kPitch = static_cast<std::size_t>(Dof::pitch);
  if (is_angle) return measure == kPitch ? 90.0 : 180.0;
  return std::numeric_limits<double>::infinity();
}

/// The range of values that the trials of a claim can produce; `n` of them are counted.
Interval attainable(const Claim& claim, const SuccessBounds& bounds, const Rows& rows, int n) {
  if (is_share(claim.statistic)) return {0.0, 100.0};
  const double limit = max_magnitude(claim, bounds, have_truth(rows));
  if (is_spread(claim)) return {0.0, limit * max_std(spread_groups(claim.statistic, rows))};
  // The two distances are not negative, so their range is half as wide.
  const bool is_distance = measure_index(claim.measure) >= kDofs;
  if (claim.statistic == "std") return {0.0, (is_distance ? 0.5 : 1.0) * limit * max_std({n})};
  const bool is_signed = !is_distance && kStatistics[statistic_index(claim.statistic)].is_signed;
  return {is_signed ? -limit : 0.0, limit};
}

bool has_enough_trials(const ClaimResult& result) {
  const bool needs_scenes = result.claim.statistic != kWithinSceneStd;
  return result.trials >= kMinClaimTrials && (!needs_scenes || result.scenes >= kMinScenes);
}

ClaimOutcome outcome_of(const ClaimResult& result) {
  if (!result.found) return ClaimOutcome::not_measured;
  if (!result.can_fail) return ClaimOutcome::shown;
  if (!has_enough_trials(result)) return ClaimOutcome::not_enough;
  const auto& [low, high] = result.claim.band;
  return *result.found >= low && *result.found <= high ? ClaimOutcome::in : ClaimOutcome::out;
}

ClaimResult check(const Claim& claim, const Summary& summary) {
  const Rows rows = rows_of(summary, claim.variant, claim.sensor);
  const TrialSummary all = pooled(scenes_of(rows));
  ClaimResult result;
  result.claim = claim;
  result.found = found(claim, rows, all);
  set_counts(result, rows, all);
  result.success_percent = percent_of(main_share(all));
  const Interval possible = attainable(claim, summary.bounds, rows, result.trials);
  result.can_fail = claim.band.front() > possible.low || claim.band.back() < possible.high;
  result.outcome = outcome_of(result);
  return result;
}

}  // namespace

std::vector<ClaimResult> check_claims(const std::vector<Claim>& claims, const Summary& summary) {
  std::vector<ClaimResult> results;
  for (const Claim& claim : claims) results.push_back(check(claim, summary));
  return results;
}

const char* name_of(ClaimOutcome outcome) {
  return std::array{"in", "out", "shown", "not enough trials", "not measured"}.at(
      static_cast<std::size_t>(outcome));
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

#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "experiments/file/claims.hpp"

namespace croon::experiments {

/// The outcome of a claim: whether the number found lies in its band.
enum class ClaimOutcome {
  in,
  out,
  shown,        ///< No number outside the band is possible, see `ClaimResult::can_fail`.
  not_enough,   ///< Fewer than `kMinClaimTrials` trials or `kMinScenes` scenes.
  not_measured  ///< The run lacks the variant, the sensor or counted trials.
};

/// All outcomes, in the order of reports.
inline constexpr std::array kClaimOutcomes = {ClaimOutcome::in, ClaimOutcome::out,
                                              ClaimOutcome::shown, ClaimOutcome::not_enough,
                                              ClaimOutcome::not_measured};

/// "in", "out", "shown", "not enough trials" or "not measured".
const char* name_of(ClaimOutcome outcome);

/// With fewer trials a number is not compared with its band. For this number the standard error of
/// a std is 13 % of it.
inline constexpr int kMinClaimTrials = 30;

/// A claim and the corresponding number of a run.
struct ClaimResult {
  Claim claim;
  std::optional<double> found;  ///< In the unit of the claim.
  ClaimOutcome outcome = ClaimOutcome::not_measured;
  int trials = 0;  ///< Number of trials that `found` is computed over.
  int scenes = 0;  ///< Number of their scenes.
  /// Whether trials could have led to a number outside the band. Errors of successful trials are
  /// within the success bounds, and so are their mean, median, RMSE and percentile.
  bool can_fail = true;
  std::optional<double> success_percent = {};  ///< Of all trials; without truth, of agreeing ones.
};

/// The unit of the numbers of a claim: "%", "deg" or "m".
const char* unit_of(const Claim& claim);

/// Checks the claims against the summary, in their order.
///
/// Without a sensor, the trials of all sensors are pooled: one mean of all their errors; spreads
/// weighted by degrees of freedom. Success requires ground truth, agreement does not.
/// `kMinScenes` does not apply to the spread within scenes. The spread of `rotation`
/// (`translation`) is the root of the sum of the squares of the spreads of its three degrees of
/// freedom. Without ground truth, statistics that require it (`kStatistics`) are not measured.
std::vector<ClaimResult> check_claims(const std::vector<Claim>& claims, const Summary& summary);

/// The statistic of roll to z, pooled over all sensors of the summary's first variant, in the units
/// of reports; std::nullopt if no trial is counted or there is no ground truth.
std::optional<DofValues> row_beside(const Quoted& quoted, const Summary& summary);

}  // namespace croon::experiments

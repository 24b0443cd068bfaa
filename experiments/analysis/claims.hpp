#pragma once

#include <array>
#include <optional>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "experiments/file/claims.hpp"

namespace croon::experiments {

/// Whether a number lies in its band.
enum class Verdict {
  in,
  out,
  shown,        ///< The band cannot fail, see `ClaimResult::can_fail`.
  not_enough,   ///< Fewer than `kLeastClaimTrials` trials or `kLeastScenes` scenes.
  not_measured  ///< The run has no such variant or sensor, or no trial that counts.
};

/// All verdicts, in the order of reports.
inline constexpr std::array kVerdicts = {Verdict::in, Verdict::out, Verdict::shown,
                                         Verdict::not_enough, Verdict::not_measured};

/// "in", "out", "shown", "not enough trials" or "not measured".
const char* verdict_name(Verdict verdict);

/// With fewer trials a number is not held against its band. The standard error of a std is then 13
/// % of it.
inline constexpr int kLeastClaimTrials = 30;

/// A claim and the number that a run has for it.
struct ClaimResult {
  Claim claim;
  std::optional<double> found;  ///< In the unit of the claim.
  Verdict verdict = Verdict::not_measured;
  int trials = 0;  ///< That the number is over.
  int scenes = 0;  ///< Of these trials.
  /// Whether trials could end so that the number is outside the band. Errors of successful trials
  /// are within the success bounds, and so are their mean, median, RMSE and percentile.
  bool can_fail = true;
  std::optional<double> success_percent = {};  ///< Of all trials; without truth their agreement.
};

/// "%", "deg" or "m": the unit of the numbers of a claim.
const char* unit_of(const Claim& claim);

/// Checks the claims against the summary, in their order.
///
/// Without a sensor, the trials of all sensors are pooled: one mean of all their errors; spreads by
/// degrees of freedom. Success needs truth, agreement does not. The spread within scenes is not
/// held against `kLeastScenes`. The spread of `rotation` (`translation`) is the root of the sum of
/// the squares of those of its three degrees of freedom. Without truth, statistics that need it
/// (`kStatistics`) are not measured.
std::vector<ClaimResult> check_claims(const std::vector<Claim>& claims, const Summary& summary);

/// The statistic of roll to z, pooled over all sensors of the summary's first variant, in the units
/// of reports; std::nullopt if no trial counts or there is no truth.
std::optional<DofValues> row_beside(const Quoted& quoted, const Summary& summary);

}  // namespace croon::experiments

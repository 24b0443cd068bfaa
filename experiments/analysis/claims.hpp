#pragma once

#include <optional>
#include <vector>

#include "experiments/analysis/summary.hpp"
#include "experiments/file/claims.hpp"

namespace croon::experiments {

/// Whether a number lies in its band.
enum class Verdict {
  in,
  out,
  not_measured  ///< The run has no such variant or sensor, or no trial that counts.
};

/// "in", "out" or "not measured".
const char* verdict_name(Verdict verdict);

/// A claim and the number that a run has for it.
struct ClaimResult {
  Claim claim;
  std::optional<double> found;  ///< In the unit of the claim.
  Verdict verdict = Verdict::not_measured;
};

/// "%", "deg" or "m": the unit of the numbers of a claim.
const char* unit_of(const Claim& claim);

/// Checks the claims against the summary, in their order.
///
/// Without a sensor, the trials of all sensors are pooled: one mean of all their errors; spreads by
/// degrees of freedom. Success is `main_share`. The spread of `rotation` (`translation`) is the
/// root of the sum of the squares of those of its three degrees of freedom. Without truth,
/// statistics that need it (`kStatistics`) are not measured.
std::vector<ClaimResult> check_claims(const std::vector<Claim>& claims, const Summary& summary);

/// The statistic of roll to z, pooled over all sensors of the summary's first variant, in the units
/// of reports; std::nullopt if no trial counts or there is no truth.
std::optional<DofValues> row_beside(const Quoted& quoted, const Summary& summary);

}  // namespace croon::experiments

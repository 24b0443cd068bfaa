#pragma once

#include <string>
#include <vector>

#include "experiments/report/claim_result.hpp"
#include "experiments/report/summary.hpp"
#include "experiments/report/table.hpp"

namespace croon::experiments {

/// Holds the summary against the claims, in their order.
///
/// Without a sensor, trials of all sensors are pooled: one mean of all their errors; spreads by
/// degrees of freedom. Success is what tables call so: near the truth, or without truth near what
/// the trials of a scene agree on. The spread of `rotation` (`translation`) is the root of the sum
/// of the squares of those of its three degrees of freedom. Where there is no truth, statistics of
/// errors other than spreads are not measured.
std::vector<ClaimResult> check_claims(const std::vector<Claim>& claims, const Summary& summary);

/// "in", "out" or "not measured".
const char* verdict_name(Verdict verdict);

/// "%", "deg" or "m": the unit of the numbers of a claim.
const char* unit_of(const Claim& claim);

/// The statistic of roll to z, pooled over all sensors of the summary's first variant, in the units
/// of reports; nothing where no trial counts or there is no truth.
std::optional<std::array<double, kDofs>> row_beside(const Quoted& quoted, const Summary& summary);

/// What `croon run` prints of the claims: claim, source, expected, band, found and verdict, then
/// the quoted rows with ours beside them. Empty where there are none of either.
std::string claims_table(const std::vector<ClaimResult>& results, const std::vector<Quoted>& quoted,
                         const Summary& summary, const TableStyle& style = {});

/// The same as Markdown, with the reasons why ours may differ below the table.
std::string claims_markdown(const std::vector<ClaimResult>& results,
                            const std::vector<Quoted>& quoted, const Summary& summary);

}  // namespace croon::experiments

#pragma once

#include <string>
#include <vector>

#include "experiments/report/claims.hpp"

namespace croon::experiments {

/// The words of a table of claims, whatever it is written as.
struct ClaimCells {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< A cell per column.
};

/// Claim, source, expected, band, found and verdict; the first two are words.
ClaimCells claim_cells(const std::vector<ClaimResult>& results);

/// Method, source and statistic in words, the degrees of freedom in the paper's order; behind the
/// rows of each statistic, that of this run's first variant over all sensors.
ClaimCells quoted_cells(const std::vector<Quoted>& quoted, const Summary& summary);

/// "50 in, 2 out, 1 not measured".
std::string verdict_counts(const std::vector<ClaimResult>& results);

}  // namespace croon::experiments

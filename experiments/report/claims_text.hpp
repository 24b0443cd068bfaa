#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/claims.hpp"
#include "experiments/report/run_text.hpp"

namespace croon::experiments {

/// What `croon run` prints of the claims: claim, source, expected, band, found and verdict, then
/// the quoted rows with ours beside them. Empty if there are none of either.
std::string claims_text(const std::vector<ClaimResult>& results, const std::vector<Quoted>& quoted,
                        const Summary& summary, const TableStyle& style = {});

/// The same as Markdown, with the reasons why ours may differ below the table.
std::string claims_markdown(const std::vector<ClaimResult>& results,
                            const std::vector<Quoted>& quoted, const Summary& summary);

/// The page of `croon claims` on one folder of results, a section of Markdown: what was run, its
/// claims, and the quoted rows of other methods.
std::string claims_section(const Results& results);

}  // namespace croon::experiments

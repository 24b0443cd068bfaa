#include "experiments/report/claim_cells.hpp"

#include <algorithm>

#include "experiments/report/text.hpp"

namespace croon::experiments {

namespace {

/// One decimal more than the paper's tables have, so that a number at the end of its band shows on
/// which side it is.
constexpr int kDecimals = 5;
constexpr int kPercentDecimals = 2;

std::string found_text(const ClaimResult& result) {
  if (!result.found) return "-";
  return fixed_number(*result.found,
                      is_share(result.claim.statistic) ? kPercentDecimals : kDecimals);
}

std::array<double, kDofs> dofs_of(const Quoted& quoted) {
  return {quoted.roll_deg, quoted.pitch_deg, quoted.yaw_deg, quoted.x_m, quoted.y_m, quoted.z_m};
}

std::vector<std::string> quoted_row(std::vector<std::string> names,
                                    const std::optional<std::array<double, kDofs>>& dofs) {
  for (const std::size_t k : kPaperOrder) {
    names.push_back(dofs ? fixed_number((*dofs)[k], kDecimals) : "-");
  }
  return names;
}

bool is_last_of_its_statistic(const std::vector<Quoted>& quoted, std::size_t index) {
  return std::none_of(
      quoted.begin() + static_cast<std::ptrdiff_t>(index) + 1, quoted.end(),
      [&](const Quoted& later) { return later.statistic == quoted[index].statistic; });
}

}  // namespace

ClaimCells claim_cells(const std::vector<ClaimResult>& results) {
  ClaimCells cells{{"claim", "source", "expected", "band", "found", "verdict"}, {}};
  for (const ClaimResult& result : results) {
    const Claim& claim = result.claim;
    cells.rows.push_back(
        {claim.claim, claim.source, plain_number(claim.value) + " " + unit_of(claim),
         "[" + plain_number(claim.band.front()) + ", " + plain_number(claim.band.back()) + "]",
         found_text(result), verdict_name(result.verdict)});
  }
  return cells;
}

ClaimCells quoted_cells(const std::vector<Quoted>& quoted, const Summary& summary) {
  ClaimCells cells{{"method", "source", "statistic"}, {}};
  for (const std::size_t k : kPaperOrder) {
    cells.header.push_back(std::string(kMeasures[k].name) + " " + kMeasures[k].unit);
  }
  for (std::size_t i = 0; i < quoted.size(); ++i) {
    const Quoted& row = quoted[i];
    cells.rows.push_back(quoted_row({row.method, row.source, row.statistic}, dofs_of(row)));
    if (!is_last_of_its_statistic(quoted, i)) continue;
    const std::string variant = summary.rows.empty() ? "" : summary.rows.front().variant;
    cells.rows.push_back(quoted_row({"ours, all sensors", "this run, " + variant, row.statistic},
                                    row_beside(row, summary)));
  }
  return cells;
}

std::string verdict_counts(const std::vector<ClaimResult>& results) {
  std::string text;
  for (const Verdict verdict : {Verdict::in, Verdict::out, Verdict::not_measured}) {
    const auto count = std::count_if(results.begin(), results.end(), [&](const ClaimResult& one) {
      return one.verdict == verdict;
    });
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + verdict_name(verdict);
  }
  return text;
}

}  // namespace croon::experiments

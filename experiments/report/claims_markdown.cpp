#include <algorithm>

#include "experiments/report/claim_cells.hpp"
#include "experiments/report/claims.hpp"
#include "experiments/report/export_formats.hpp"

namespace croon::experiments {

namespace {

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string row = "|";
  for (const std::string& cell : cells) row += " " + markdown_escaped(cell) + " |";
  return row + "\n";
}

std::string markdown_table(const ClaimCells& cells) {
  std::string text = markdown_row(cells.header) + "|";
  for (std::size_t i = 0; i < cells.header.size(); ++i) text += "---|";
  text += "\n";
  for (const std::vector<std::string>& row : cells.rows) text += markdown_row(row);
  return text;
}

/// The number of `reason` among `reasons`, which it joins where it is new; counted from 1.
std::size_t number_of(const std::string& reason, std::vector<std::string>& reasons) {
  const auto known = std::find(reasons.begin(), reasons.end(), reason);
  const std::size_t index = known - reasons.begin();
  if (known == reasons.end()) reasons.push_back(reason);
  return index + 1;
}

/// The table of claims, with the numbers of the reasons below it.
std::string results_markdown(const std::vector<ClaimResult>& results) {
  ClaimCells cells = claim_cells(results);
  cells.header.emplace_back("why ours may differ");
  std::vector<std::string> reasons;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::string& why = results[i].claim.why;
    cells.rows[i].push_back(why.empty() ? "" : std::to_string(number_of(why, reasons)));
  }
  std::string text = "Claims: " + verdict_counts(results) + ".\n\n" + markdown_table(cells);
  if (!reasons.empty()) text += "\nWhy ours may differ:\n\n";
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    text += std::to_string(i + 1) + ". " + markdown_escaped(reasons[i]) + "\n";
  }
  return text;
}

}  // namespace

std::string claims_markdown(const std::vector<ClaimResult>& results,
                            const std::vector<Quoted>& quoted, const Summary& summary) {
  std::string text;
  if (!results.empty()) text += results_markdown(results);
  if (!quoted.empty()) {
    text += std::string(text.empty() ? "" : "\n") +
            "Other methods, as their sources have them, and ours:\n\n" +
            markdown_table(quoted_cells(quoted, summary));
  }
  return text;
}

}  // namespace croon::experiments

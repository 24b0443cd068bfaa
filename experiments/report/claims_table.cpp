#include <algorithm>
#include <sstream>

#include "experiments/report/claim_cells.hpp"
#include "experiments/report/claims.hpp"
#include "experiments/report/text.hpp"
#include "experiments/report/text_table.hpp"

namespace croon::experiments {

namespace {

constexpr std::size_t kWidestName = 44;

/// `text` with the last word of the lines that end in `word` in red.
std::string reddened(const std::string& text, const std::string& word) {
  std::string coloured;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t start = line.size() - std::min(line.size(), word.size());
    if (line.substr(start) == word) line = line.substr(0, start) + "\033[31m" + word + "\033[0m";
    coloured += line + "\n";
  }
  return coloured;
}

bool ends_line(char c) { return c == '\n' || c == '\r'; }

/// The first `names` columns are words.
TextTable text_table(const ClaimCells& cells, std::size_t names) {
  TextTable table(cells.header, names);
  for (std::vector<std::string> row : cells.rows) {
    for (std::size_t i = 0; i < names; ++i) {
      std::replace_if(row[i].begin(), row[i].end(), ends_line, ' ');
      row[i] = cut_to_columns(row[i], kWidestName);
    }
    table.add(std::move(row));
  }
  return table;
}

}  // namespace

std::string claims_table(const std::vector<ClaimResult>& results, const std::vector<Quoted>& quoted,
                         const Summary& summary, const TableStyle& style) {
  std::string text;
  if (!results.empty()) {
    const std::string table = text_table(claim_cells(results), 2).text(style.colours);
    text += "\nclaims: " + verdict_counts(results) + "\n";
    text += style.colours ? reddened(table, verdict_name(Verdict::out)) : table;
  }
  if (!quoted.empty()) {
    text += "\nother methods, as their sources have them, and ours\n" +
            text_table(quoted_cells(quoted, summary), 3).text(style.colours);
  }
  return text;
}

}  // namespace croon::experiments

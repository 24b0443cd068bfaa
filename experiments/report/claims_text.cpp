#include <algorithm>
#include <optional>
#include <regex>

#include "experiments/report/build_text.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/report/run_text.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

namespace {

constexpr std::size_t kMaxNameColumns = 44;

/// Claim, source, expected, band, found and verdict; `open` and `close` are the brackets of the
/// band.
View claims_view(const std::string& open, const std::string& close) {
  return {{{"claim"},
           {"source"},
           {"trials"},
           {"scenes"},
           {"share %", "<success_percent>"},
           {"expected", "<expected> <unit>"},
           {"band", open + "<low>, <high>" + close},
           {"found"},
           {"verdict"}},
          2};
}

/// The quoted rows, DOFs in the paper's order. The rows of each statistic are followed by the
/// result of this run's first variant over all sensors.
Table quoted_table(const std::vector<Quoted>& quoted, const Summary& summary) {
  constexpr int kDecimals = 5;
  Table table{{{"method"}, {"source"}, {"statistic"}}, {}};
  for (const std::size_t k : kPaperOrder) {
    table.columns.push_back({title_of(kMeasures[k]), "", "", kDecimals});
  }
  const auto add = [&](const std::string& method, const std::string& source,
                       const std::string& statistic, const std::optional<DofValues>& dofs) {
    CellRow row = cell_row(method, source, statistic);
    for (const std::size_t k : kPaperOrder) row.push_back(dofs ? to_cell((*dofs)[k]) : Cell());
    table.rows.push_back(std::move(row));
  };
  for (auto q = quoted.begin(); q != quoted.end(); ++q) {
    add(q->method, q->source, q->statistic,
        DofValues{q->roll_deg, q->pitch_deg, q->yaw_deg, q->x_m, q->y_m, q->z_m});
    const bool has_later = std::any_of(
        q + 1, quoted.end(), [&](const Quoted& later) { return later.statistic == q->statistic; });
    if (has_later) continue;
    const std::string variant = summary.rows.empty() ? "" : summary.rows.front().variant;
    add("ours, all sensors", "this run, " + variant, q->statistic, row_beside(*q, summary));
  }
  return table;
}

/// Explains the columns and the verdicts other than "in" and "out".
std::string outcomes_explained() {
  return "trials, scenes: included in the number; share: trials that succeed (no ground truth: "
         "that "
         "agree), in % of all.\nshown: no result within the success bounds could be outside the "
         "band. not enough trials: fewer than " +
         std::to_string(kMinClaimTrials) + " trials or " + std::to_string(kMinScenes) +
         " scenes.\n";
}

/// "50 in, 2 out, 1 not measured".
std::string outcome_counts(const std::vector<ClaimResult>& results) {
  std::string text;
  for (const ClaimOutcome outcome : kClaimOutcomes) {
    const auto count = std::count_if(results.begin(), results.end(), [&](const ClaimResult& one) {
      return one.outcome == outcome;
    });
    if (count == 0) continue;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name_of(outcome);
  }
  return text;
}

/// The table of claims, followed by the numbered reasons.
std::string results_markdown(const std::vector<ClaimResult>& results) {
  std::vector<std::string> reasons;
  Columns<ClaimResult> columns = claim_columns();
  columns.add({"why ours may differ"}, [&](const ClaimResult& result) -> std::string {
    if (result.claim.why.empty()) return "";
    const auto known = std::find(reasons.begin(), reasons.end(), result.claim.why);
    const auto index = known - reasons.begin();
    if (known == reasons.end()) reasons.push_back(result.claim.why);
    return std::to_string(index + 1);
  });
  View view = claims_view("\\[", "\\]");
  view.columns.push_back({"why ours may differ"});
  view.names = view.columns.size();
  std::string text = "Claims: " + outcome_counts(results) + ".\n\n" + outcomes_explained() + "\n" +
                     markdown_table(columns.table(results), view);
  if (!reasons.empty()) text += "\nWhy ours may differ:\n\n";
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    text += std::to_string(i + 1) + ". " + markdown_escaped(reasons[i]) + "\n";
  }
  return text;
}

/// The run, as a table of one row.
std::string run_markdown(const Results& results) {
  const std::string trials =
      std::to_string(results.records.size()) + " of " + std::to_string(results.planned);
  const Table table{{{"scenes"}, {"sensors"}, {"starts of each"}, {"trials"}, {"seed"}, {"commit"}},
                    {cell_row(results.scenes, sensors_of(results.summary).size(), results.trials,
                              trials, std::to_string(results.seed), results.commit)}};
  return markdown_table(table, whole_view(table, table.columns.size()));
}

}  // namespace

std::string claims_text(const std::vector<ClaimResult>& results, const std::vector<Quoted>& quoted,
                        const Summary& summary, const TableStyle& style) {
  std::string text;
  if (!results.empty()) {
    View view = claims_view("[", "]");
    view.max_name_columns = kMaxNameColumns;
    const std::string table = text_table(claim_columns().table(results), view, style.colours);
    const std::regex out("out\n");  // In red.
    text += "\nclaims: " + outcome_counts(results) + "\n";
    text += style.colours ? std::regex_replace(table, out, "\033[31mout\033[0m\n") : table;
    text += outcomes_explained();
  }
  if (!quoted.empty()) {
    const Table table = quoted_table(quoted, summary);
    View view = whole_view(table, 3);
    view.max_name_columns = kMaxNameColumns;
    text += "\nother methods as published, and ours\n" + text_table(table, view, style.colours);
  }
  return text;
}

std::string claims_markdown(const std::vector<ClaimResult>& results,
                            const std::vector<Quoted>& quoted, const Summary& summary) {
  std::string text;
  if (!results.empty()) text += results_markdown(results);
  if (!quoted.empty()) {
    const Table table = quoted_table(quoted, summary);
    text += std::string(text.empty() ? "" : "\n") + "Other methods as published, and ours:\n\n" +
            markdown_table(table, whole_view(table, table.columns.size()));
  }
  return text;
}

std::string claims_section(const Results& results) {
  std::string text = "\n## " + markdown_escaped(results.name) + "\n\n";
  if (!results.description.empty()) text += markdown_escaped(results.description) + "\n\n";
  text += run_markdown(results) + "\n";
  for (const std::string& sentence : build_sentences(results.builds)) {
    text += markdown_escaped(sentence) + "\n\n";
  }
  const std::string tables = claims_markdown(results.claims, results.quoted, results.summary);
  return text + (tables.empty() ? "The experiment makes no claims.\n" : tables);
}

}  // namespace croon::experiments

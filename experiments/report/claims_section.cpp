#include <algorithm>
#include <optional>

#include "experiments/report/result_sections.hpp"
#include "experiments/report/result_tables.hpp"

namespace croon::experiments {

namespace {

constexpr std::size_t kMaxNameColumns = 44;

/// "50 in, 2 out, 1 not measured"; a warning if any is out.
Paragraph outcome_counts(const std::vector<ClaimResult>& results) {
  Paragraph counts;
  for (const ClaimOutcome outcome : kClaimOutcomes) {
    const auto count = std::count_if(results.begin(), results.end(), [&](const ClaimResult& one) {
      return one.outcome == outcome;
    });
    if (count == 0) continue;
    if (outcome == ClaimOutcome::out) counts.tone = Tone::warning;
    counts.text +=
        (counts.text.empty() ? "" : ", ") + std::to_string(count) + " " + name_of(outcome);
  }
  return counts;
}

/// The claims. The column "why" has the numbers of `reasons`, to which the reasons are added.
TableBlock claims_table(const std::vector<ClaimResult>& results, Facts& reasons) {
  View view{{{"claim"},
             {"source"},
             {"trials"},
             {"scenes"},
             {"share %", "<success_percent>"},
             {"expected", "<expected> <unit>"},
             {"band", "[<low>, <high>]"},
             {"found"},
             {"verdict"}},
            2};
  view.max_name_columns = kMaxNameColumns;
  Columns<ClaimResult> columns = claim_columns();
  columns.add({"why"}, [&](const ClaimResult& result) -> std::optional<std::string> {
    const std::string& why = result.claim.why;
    if (why.empty()) return std::nullopt;
    auto& facts = reasons.facts;
    const auto known = std::find_if(facts.begin(), facts.end(),
                                    [&](const auto& reason) { return reason.second == why; });
    if (known != facts.end()) return known->first;
    facts.emplace_back(std::to_string(facts.size() + 1), why);
    return facts.back().first;
  });
  const Table table = columns.table(results);
  if (!reasons.facts.empty()) view.columns.push_back({"why"});
  return {"",
          table,
          view,
          {"Trials, scenes: included in the number; share: trials that succeed (no ground truth: "
           "that agree), in % of all.",
           "Shown: no result within the success bounds could be outside the band.",
           "Not enough trials: fewer than " + std::to_string(kMinClaimTrials) + " trials or " +
               std::to_string(kMinScenes) + " scenes."}};
}

}  // namespace

Section claims_section(const Results& results) {
  if (results.claims.empty()) return {};
  Facts reasons;
  const TableBlock table = claims_table(results.claims, reasons);
  Section section{"claims", "Claims", {outcome_counts(results.claims), table}};
  if (reasons.facts.empty()) return section;
  section.blocks.emplace_back(Paragraph{"Why ours may differ:"});
  section.blocks.emplace_back(std::move(reasons));
  return section;
}

Section quoted_section(const Results& results) {
  constexpr int kDecimals = 5;
  const std::vector<Quoted>& quoted = results.quoted;
  if (quoted.empty()) return {};
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
  // The rows of each statistic are followed by the first variant over all sensors.
  for (auto q = quoted.begin(); q != quoted.end(); ++q) {
    add(q->method, q->source, q->statistic,
        DofValues{q->roll_deg, q->pitch_deg, q->yaw_deg, q->x_m, q->y_m, q->z_m});
    const bool has_later = std::any_of(
        q + 1, quoted.end(), [&](const Quoted& later) { return later.statistic == q->statistic; });
    if (has_later) continue;
    const std::vector<SummaryRow>& rows = results.summary.rows;
    const std::string variant = rows.empty() ? "" : rows.front().variant;
    add("ours, all sensors", "this run, " + variant, q->statistic, row_beside(*q, results.summary));
  }
  View view = whole_view(table, 3);
  view.max_name_columns = kMaxNameColumns;
  return {"published", "Other methods as published, and ours", {TableBlock{"", table, view}}};
}

}  // namespace croon::experiments

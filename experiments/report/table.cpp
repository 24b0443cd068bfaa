#include "experiments/report/table.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/report/csv_row.hpp"
#include "experiments/report/row_table.hpp"
#include "experiments/report/text.hpp"
#include "experiments/run/trial_record.hpp"

namespace croon::experiments {

namespace {

std::vector<std::string> dof_columns() {
  std::vector<std::string> names;
  for (const std::size_t k : kPaperOrder) {
    names.push_back(std::string(kMeasures[k].name) + " " + kMeasures[k].unit);
  }
  return names;
}

/// A table with a row for each row of the summary, named by variant and sensor.
std::string row_table(const Summary& summary, const TableStyle& style,
                      const std::vector<std::string>& columns,
                      std::vector<std::string> (*cells_of)(const SummaryRow&)) {
  RowTable table(summary, {"sensor"}, columns);
  for (const SummaryRow& row : summary.rows) table.add(row.variant, {row.sensor}, cells_of(row));
  return table.text(style);
}

std::vector<std::string> outcome_cells(const SummaryRow& row) {
  const Share& share = main_share(row);
  std::vector<std::string> cells = {share_text(share), percent(share.ratio), interval_text(share)};
  for (const int count : {row.outcomes.inaccurate, row.outcomes.rejected, row.outcomes.failed}) {
    cells.push_back(std::to_string(count));
  }
  for (std::size_t k = kDofs; k < kMeasures.size(); ++k) {
    cells.push_back(row.statistics ? median_and_p95((*row.statistics)[k], kMeasures[k]) : "-");
  }
  return cells;
}

std::vector<std::string> deviation_cells(const SummaryRow& row) {
  std::vector<std::string> cells;
  for (const std::size_t k : kPaperOrder) {
    if (!row.statistics) {
      cells.push_back("-");
      continue;
    }
    const MeasureStatistics& statistics = (*row.statistics)[k];
    const int decimals = decimals_of(kMeasures[k]);
    cells.push_back(fixed_number(statistics.mean, decimals) + " ±" +
                    (std::isnan(statistics.std) ? "-" : fixed_number(statistics.std, decimals)));
  }
  return cells;
}

std::vector<std::string> spread_cells(const SummaryRow& row) {
  std::vector<std::string> cells;
  for (const std::size_t k : kPaperOrder) {
    const int decimals = decimals_of(kMeasures[k]);
    const auto text = [&](const std::optional<std::array<double, kDofs>>& spread) {
      return spread ? fixed_number((*spread)[k], decimals) : "-";
    };
    cells.push_back(text(row.within_scene_std) + " / " + text(row.across_scenes_std));
  }
  return cells;
}

std::string bounds_text(const SuccessBounds& bounds) {
  return shortest_number(bounds.rotation_deg) + " deg and " +
         shortest_number(bounds.translation_m) + " m of ";
}

/// Whether a row's deviations are from `reference`.
bool uses(const Summary& summary, Reference reference) {
  return std::any_of(summary.rows.begin(), summary.rows.end(),
                     [&](const SummaryRow& row) { return row.reference == reference; });
}

/// One sentence on what the numbers mean.
std::string explanation(const Summary& summary) {
  std::string text;
  if (uses(summary, Reference::truth)) {
    text +=
        "success: within " + bounds_text(summary.bounds) + "the truth; errors of those trials\n";
  }
  if (uses(summary, Reference::consensus)) {
    text += "success (no truth): within " + bounds_text(summary.bounds) +
            "what the trials of the scene agree on;\n  deviations of those trials from what all "
            "scenes agree on\n";
  }
  return text + "rotation, translation: median, 95th percentile\n";
}

/// "1 trial", "2 trials".
std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string reasons_text(const Summary& summary, const TableStyle& style) {
  if (summary.reasons.empty()) return "";
  RowTable table(summary, {"status", "reason"}, {"trials"});
  std::size_t shown = 0;
  int trials_left = 0;
  for (const ReasonCount& reason : summary.reasons) {
    if (shown == style.max_reasons) {
      trials_left += reason.count;
      continue;
    }
    ++shown;
    table.add(reason.variant, {status_name(reason.status), cut_to_columns(reason.reason, 80)},
              {std::to_string(reason.count)});
  }
  std::string text = "\n" + table.text(style);
  if (trials_left > 0) {
    text += "and " + counted(summary.reasons.size() - shown, "other reason") + " of " +
            counted(static_cast<std::size_t>(trials_left), "trial") + "\n";
  }
  return text;
}

bool has_several_trials_per_scene(const Summary& summary) {
  return std::any_of(summary.rows.begin(), summary.rows.end(),
                     [](const SummaryRow& row) { return row.within_scene_std.has_value(); });
}

bool has_several_scenes(const Summary& summary) {
  return std::any_of(summary.rows.begin(), summary.rows.end(),
                     [](const SummaryRow& row) { return row.scenes.size() > 1; });
}

}  // namespace

std::string summary_table(const Summary& summary, const TableStyle& style) {
  if (summary.rows.empty()) return "no trials\n";
  const bool is_split = has_several_scenes(summary);
  std::string text = explanation(summary) + "\n";
  text += row_table(summary, style,
                    {"success", "%", "95 % interval", "inaccurate", "rejected", "failed",
                     "rotation deg", "translation m"},
                    outcome_cells);
  text += "\nmean ± std\n" + row_table(summary, style, dof_columns(), deviation_cells);
  if (is_split && has_several_trials_per_scene(summary)) {
    text += "\nstd within scenes / across scenes\n";
    text += row_table(summary, style, dof_columns(), spread_cells);
  }
  if (!summary.comparisons.empty()) {
    text += "\nagainst " + summary.comparisons.front().base +
            ", pair by pair: difference of medians [95 % interval], failures as infinite\n";
    if (uses(summary, Reference::consensus)) {
      text +=
          "  (no truth: of the distances to what the variant's own trials of the scene agree "
          "on, so of how\n  repeatable it is, not how accurate)\n";
    }
    text += comparison_table(summary, style);
  }
  if (!summary.loops.empty()) {
    text += "\nloops over the reference: closed within " + bounds_text(summary.bounds) +
            "the identity; how far loops are from it\n" + loop_table(summary, style);
  }
  if (!summary.kinds.empty()) {
    text += "\nby kind of scene: success in %\n" + kind_table(summary, style);
  }
  if (is_split) {
    text += "\nsuccess per scene\n" + scene_table(summary, style);
  }
  return text + reasons_text(summary, style);
}

}  // namespace croon::experiments

#include <algorithm>
#include <optional>
#include <utility>

#include "experiments/report/columns.hpp"
#include "experiments/report/export.hpp"
#include "experiments/report/renderers.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/report/run_text.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {

namespace {

/// Adds median and 95th percentile of the two distances.
void add_distances(View& view) {
  for (const std::size_t k : {kRotation, kTranslation}) {
    view.columns.push_back({kMeasures[k].name + (" " + std::string(kMeasures[k].unit)),
                            content_of(kMeasures[k], "<median>, <p95>")});
  }
}

View outcome_view() {
  View view{{{"sensor"},
             {"success", "<success>/<trials>"},
             {"%", "<success_percent>"},
             {"95 % interval", "[<success_low_percent>, <success_high_percent>]"},
             {"inaccurate"},
             {"rejected"},
             {"failed"}}};
  add_distances(view);
  return view;
}

View dof_view(const std::string& content) {
  View view{{{"sensor"}}};
  add_dofs(view, content);
  return view;
}

/// The columns of the tables with a row per variant and sensor.
Columns<SummaryRow> row_columns() {
  Columns<SummaryRow> columns = export_columns();
  return columns.add({"inaccurate"}, [](const SummaryRow& row) { return row.outcomes.inaccurate; })
      .add({"rejected"}, [](const SummaryRow& row) { return row.outcomes.rejected; })
      .add({"failed"}, [](const SummaryRow& row) { return row.outcomes.failed; })
      .add(dof_columns("within_scene_std"), &SummaryRow::within_scene_std)
      .add(dof_columns("across_scenes_std"), &SummaryRow::across_scenes_std);
}

/// The p of a test, corrected, with its mark.
std::string p_text(const PairedTest& test) {
  const char* mark = holds_by_scene(test) ? "**" : is_significant(test) ? "*" : "";
  return (test.p_holm < 0.001 ? "<0.001" : fixed_number(test.p_holm, 3)) + mark;
}

std::string comparison_text(const Summary& summary, const TableStyle& style) {
  using C = Comparison;
  Columns<C> columns = comparison_columns();
  columns.add({"p_success"}, [](const C& c) { return p_text(c.success); })
      .add({"p_rotation"}, [](const C& c) { return p_text(c.rotation_deg.test); })
      .add({"p_translation"}, [](const C& c) { return p_text(c.translation_m.test); });
  std::vector<C> of_all_sensors;
  for (const C& comparison : summary.comparisons) {
    if (comparison.sensor.empty()) of_all_sensors.push_back(comparison);
  }
  const char* const difference = "<difference> [<low>, <high>]";
  const View view{{{"pairs"},
                   {"won", "<only_variant>"},
                   {"lost", "<only_base>"},
                   {"p", "<p_success>"},
                   {"rotation deg", content_of(kMeasures[kRotation], difference)},
                   {"p", "<p_rotation>"},
                   {"translation m", content_of(kMeasures[kTranslation], difference)},
                   {"p", "<p_translation>"}},
                  0};
  return text_table(columns.table(of_all_sensors), view_by_variant(view, variants_of(summary)),
                    style.colours) +
         "* p < 0.05 over trials (McNemar, Wilcoxon; Holm), ** also with scenes as units\n";
}

std::string loop_text(const Summary& summary, const TableStyle& style) {
  View view{{{"loop", "<pair>"},
             {"closed", "<closed>/<loops>"},
             {"%", "<closed_ratio>"},
             {"95 % interval", "[<closed_low_ratio>, <closed_high_ratio>]"}}};
  add_distances(view);
  return text_table(loop_columns().table(summary.loops),
                    view_by_variant(view, variants_of(summary)), style.colours);
}

std::string reason_text(const Summary& summary, const TableStyle& style) {
  if (summary.reasons.empty()) return "";
  const std::size_t shown = std::min(style.max_reasons, summary.reasons.size());
  const auto first_left = summary.reasons.begin() + static_cast<std::ptrdiff_t>(shown);
  Columns<ReasonCount> columns;
  columns.add({"variant"}, &ReasonCount::variant)
      .add({"status"}, [](const ReasonCount& reason) { return status_name(reason.status); })
      .add({"reason"}, &ReasonCount::reason)
      .add({"trials"}, &ReasonCount::count);
  View view{{{"status"}, {"reason"}, {"trials"}}, 2};
  view.widest_name = 80;
  std::string text = "\n" + text_table(columns.table({summary.reasons.begin(), first_left}),
                                       view_by_variant(view, variants_of(summary)), style.colours);
  std::size_t trials_left = 0;
  for (auto reason = first_left; reason != summary.reasons.end(); ++reason) {
    trials_left += static_cast<std::size_t>(reason->count);
  }
  if (trials_left > 0) {
    text += "and " + counted(summary.reasons.size() - shown, "other reason") + " of " +
            counted(trials_left, "trial") + "\n";
  }
  return text;
}

bool has_deviations_from(const Summary& summary, DeviationsFrom from) {
  return std::any_of(summary.rows.begin(), summary.rows.end(),
                     [&](const SummaryRow& row) { return row.deviations_from == from; });
}

/// The meaning of the numbers, in a few lines.
std::string explanation(const Summary& summary) {
  std::string text;
  if (has_deviations_from(summary, DeviationsFrom::truth)) {
    text +=
        "success: within " + bounds_text(summary.bounds) + "the truth; errors of those trials\n";
  }
  if (has_deviations_from(summary, DeviationsFrom::consensus)) {
    text += "success (no truth): within " + bounds_text(summary.bounds) +
            "what the trials of the scene agree on;\n  deviations of those trials from what all "
            "scenes agree on\n";
  }
  return text + "rotation, translation: median, 95th percentile\n";
}

std::string against_base_text(const Summary& summary, const TableStyle& style) {
  std::string text =
      "\nagainst " + summary.comparisons.front().base +
      ", pair by pair: difference of medians [95 % interval], failures as infinite\n";
  if (has_deviations_from(summary, DeviationsFrom::consensus)) {
    text +=
        "  (no truth: of the distances to what the variant's own trials of the scene agree "
        "on, so of how\n  repeatable it is, not how accurate)\n";
  }
  return text + comparison_text(summary, style);
}

}  // namespace

std::string summary_text(const Summary& summary, const TableStyle& style) {
  if (summary.rows.empty()) return "no trials\n";
  const Table table = row_columns().table(summary.rows);
  const auto rows_text = [&](const View& view) {
    return text_table(table, view_by_variant(view, variants_of(summary)), style.colours);
  };
  const auto any_row = [&](auto condition) {
    return std::any_of(summary.rows.begin(), summary.rows.end(), condition);
  };
  const bool has_scenes = any_row([](const SummaryRow& row) { return row.scenes.size() > 1; });
  const bool has_spread = any_row([](const SummaryRow& row) { return !!row.within_scene_std; });
  std::string text = explanation(summary) + "\n" + rows_text(outcome_view()) + "\nmean ± std\n" +
                     rows_text(dof_view("<mean> ±<std>"));
  if (has_scenes && has_spread) {
    View spreads = dof_view("<within_scene_std> / <across_scenes_std>");
    for (Shown& shown : spreads.columns) shown.shows_each = true;
    text += "\nstd within scenes / across scenes\n" + rows_text(spreads);
  }
  if (!summary.comparisons.empty()) text += against_base_text(summary, style);
  if (!summary.loops.empty()) {
    text += "\nloops over the reference: closed within " + bounds_text(summary.bounds) +
            "the identity; how far loops are from it\n" + loop_text(summary, style);
  }
  if (!summary.scene_kinds.empty()) {
    text += "\nby kind of scene: success in %\n" + scene_kind_text(summary, style);
  }
  if (has_scenes) text += "\nsuccess per scene\n" + scene_text(summary, style);
  return text + reason_text(summary, style);
}

}  // namespace croon::experiments

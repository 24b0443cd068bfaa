#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

#include "experiments/report/export.hpp"
#include "experiments/report/result_tables.hpp"
#include "experiments/report/run_text.hpp"
#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

namespace {

/// A table whose rows belong to variants. The variant is in the first column, in a heading if a
/// name is long, or omitted if there is only one variant.
std::string text_by_variant(const Table& table, View view, const Summary& summary,
                            const TableStyle& style) {
  constexpr std::size_t kLongName = 16;
  const std::vector<std::string> variants = variants_of(summary);
  const bool has_long_name =
      std::any_of(variants.begin(), variants.end(),
                  [](const std::string& name) { return text_columns(name) > kLongName; });
  if (variants.size() > 1 && has_long_name) {
    view.heading = "variant";
  } else if (variants.size() > 1) {
    view.columns.insert(view.columns.begin(), {"variant"});
    ++view.names;
  }
  return text_table(table, view, style.colours);
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

/// The corrected p value of a test, with its mark.
std::string p_text(const PairedTest& test) {
  const char* mark = is_significant_by_scene(test) ? "**" : is_significant(test) ? "*" : "";
  return (test.p_holm < 0.001 ? "<0.001" : fixed_number(test.p_holm, 3)) + mark;
}

/// The median of the paired differences, with its interval if there is one.
std::string difference_text(const ErrorComparison& error, const Measure& measure) {
  const auto text = [&](double value) { return fixed_number(value, measure.decimals + 1); };
  const std::string difference = text(error.paired_difference);
  if (!error.paired_interval) return difference;
  return difference + " [" + text(error.paired_interval->low) + ", " +
         text(error.paired_interval->high) + "]";
}

std::string comparison_text(const Summary& summary, const TableStyle& style) {
  using C = Comparison;
  Columns<C> columns = comparison_columns();
  columns.add({"p_success"}, [](const C& c) { return p_text(c.success); })
      .add({"p_rotation"}, [](const C& c) { return p_text(c.rotation_deg.test); })
      .add({"p_translation"}, [](const C& c) { return p_text(c.translation_m.test); })
      .add({"d_rotation"},
           [](const C& c) { return difference_text(c.rotation_deg, kMeasures[kRotation]); })
      .add({"d_translation"},
           [](const C& c) { return difference_text(c.translation_m, kMeasures[kTranslation]); });
  Table of_all_sensors{columns.columns(), {}};
  for (const C& comparison : summary.comparisons) {
    if (comparison.sensor.empty()) of_all_sensors.rows.push_back(columns.cells(comparison));
  }
  View view{{{"pairs"}, {"won", "<only_variant>"}, {"lost", "<only_base>"}, {"p", "<p_success>"}},
            0};
  for (const std::size_t k : kDistances) {
    view.columns.push_back({title_of(kMeasures[k]), std::string("<d_") + kMeasures[k].name + ">"});
    view.columns.push_back({"p", std::string("<p_") + kMeasures[k].name + ">"});
  }
  return text_by_variant(of_all_sensors, view, summary, style) +
         "* p < 0.05 over trials (McNemar, Wilcoxon; Holm), ** also with "
         "scenes as units\n";
}

std::string loop_text(const Summary& summary, const TableStyle& style) {
  View view{{{"loop", "<pair>"},
             {"closed", "<closed>/<loops>"},
             {"%", "<closed_ratio>"},
             {"95 % interval", "[<closed_low_ratio>, <closed_high_ratio>]"}}};
  add_measures(view, kDistances, {"median", "p95"}, ", ");
  view.columns.push_back({"scenes", "<scenes_closed>/<scenes>"});
  view.columns.push_back({"agreed deg, m", "<agreed_rotation_deg>, <agreed_translation_m>"});
  return text_by_variant(loop_columns().table(summary.loops), view, summary, style) +
         "scenes: loops over each scene's consensus that close; agreed: the loop over the "
         "consensus of all scenes\n";
}

/// Adds a column for each title; titles may coincide with names of other columns.
void add_titled(Table& table, View& view, const std::vector<std::string>& titles, int decimals) {
  for (const std::string& title : titles) {
    const std::string name = "column " + std::to_string(table.columns.size());
    table.columns.push_back({name, "", "", decimals});
    view.columns.push_back({title, "<" + name + ">"});
  }
}

/// The poses that all scenes agree on, for rows without ground truth.
std::string agreed_text(const Summary& summary, const TableStyle& style) {
  Columns<SummaryRow> columns;
  columns.add({"variant"}, &SummaryRow::variant)
      .add({"sensor"}, &SummaryRow::sensor)
      .add(agreed_pose_columns(), [](const SummaryRow& row) { return agreed_pose(row); });
  Table table{columns.columns(), {}};
  for (const SummaryRow& row : summary.rows) {
    if (lacks_truth(row)) table.rows.push_back(columns.cells(row));
  }
  const View view{{{"sensor"},
                   {"x m", "<tx_m>"},
                   {"y m", "<ty_m>"},
                   {"z m", "<tz_m>"},
                   {"roll deg", "<roll_deg>"},
                   {"pitch deg", "<pitch_deg>"},
                   {"yaw deg", "<yaw_deg>"},
                   {"agreeing", "<agreeing>/<trials>"},
                   {"spread deg, m", "<spread_deg>, <spread_m>"}}};
  return text_by_variant(table, view, summary, style);
}

/// Success in % per variant, kind of scene (rows) and sensor (columns).
std::string scene_kind_text(const Summary& summary, const TableStyle& style) {
  const std::vector<std::string> sensors = sensors_of(summary);
  Table table{{{"variant"}, {"kind"}, {"scenes"}, {"trials"}}, {}};
  View view{{{"kind"}, {"scenes"}, {"trials"}}};
  add_titled(table, view, {kAllSensors}, 1);
  add_titled(table, view, sensors, 1);
  std::map<std::string, double> percents;  // By sensor.
  for (const SceneKindSummary& kind : summary.scene_kinds) {
    percents[kind.sensor] = 100.0 * main_share(kind).ratio;
    if (!kind.sensor.empty()) continue;
    // The row over all sensors is the last one of its kind.
    CellRow row = cell_row(kind.variant, nothing_if_empty(kind.scene_kind), kind.scene_count,
                           kind.outcomes.trials, percents[""]);
    for (const std::string& sensor : sensors) {
      row.push_back(percents.count(sensor) > 0 ? to_cell(percents[sensor]) : Cell());
    }
    table.rows.push_back(std::move(row));
    percents.clear();
  }
  return text_by_variant(table, view, summary, style);
}

/// The indices of the `count` worst scenes, ascending. `ratios` has the success of each scene by
/// sensor; scenes are ordered by the minimum ratio over sensors, then by the sum.
std::vector<std::size_t> worst_of(const std::vector<std::map<std::string, double>>& ratios,
                                  std::size_t count) {
  std::vector<std::tuple<double, double, std::size_t>> order;
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    double min_ratio = std::numeric_limits<double>::infinity();
    double sum = 0.0;
    for (const auto& [sensor, ratio] : ratios[i]) {
      min_ratio = std::min(min_ratio, ratio);
      sum += ratio;
    }
    order.emplace_back(min_ratio, sum, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> worst;
  for (std::size_t k = 0; k < std::min(count, order.size()); ++k) {
    worst.push_back(std::get<2>(order[k]));
  }
  std::sort(worst.begin(), worst.end());
  return worst;
}

/// Success per variant, scene (rows) and sensor (columns). If there are more than
/// `style.max_scenes` rows, the worst are shown, in their original order.
std::string scene_text(const Summary& summary, const TableStyle& style) {
  Table all{{{"variant"}, {"scene"}}, {}};
  View view{{{"scene"}}};
  const std::vector<std::string> sensors = sensors_of(summary);
  add_titled(all, view, sensors, 0);
  std::vector<std::map<std::string, double>> ratios;
  std::map<std::pair<std::string, std::string>, std::size_t> rows;
  for (const SummaryRow& row : summary.rows) {
    const auto sensor = std::find(sensors.begin(), sensors.end(), row.sensor) - sensors.begin();
    for (const SceneSummary& scene : row.scenes) {
      const auto [entry, is_new] = rows.insert({{row.variant, scene.scene}, all.rows.size()});
      if (is_new) {
        all.rows.push_back(cell_row(row.variant, scene.scene));
        all.rows.back().resize(all.columns.size());
        ratios.emplace_back();
      }
      if (!is_judged_as(row, scene)) continue;
      const Share& share = main_share(scene);
      all.rows[entry->second][2 + static_cast<std::size_t>(sensor)] =
          to_cell(std::to_string(share.count) + "/" + std::to_string(share.trials));
      ratios[entry->second][row.sensor] = share.ratio;
    }
  }
  Table shown{all.columns, {}};
  for (const std::size_t i : worst_of(ratios, style.max_scenes)) shown.rows.push_back(all.rows[i]);
  const std::string text = text_by_variant(shown, view, summary, style);
  if (shown.rows.size() == all.rows.size()) return text;
  return text + "the worst " + std::to_string(shown.rows.size()) + " of " +
         std::to_string(all.rows.size()) + " rows\n";
}

std::string reason_text(const Summary& summary, const TableStyle& style) {
  if (summary.reasons.empty()) return "";
  const std::size_t shown = std::min(style.max_reasons, summary.reasons.size());
  const auto first_left = summary.reasons.begin() + static_cast<std::ptrdiff_t>(shown);
  View view{{{"status"}, {"reason"}, {"trials", "<count>"}}, 2};
  view.max_name_columns = 80;
  std::string text =
      "\n" + text_by_variant(reason_columns().table({summary.reasons.begin(), first_left}), view,
                             summary, style);
  const int trials_left =
      std::accumulate(first_left, summary.reasons.end(), 0,
                      [](int count, const ReasonCount& reason) { return count + reason.count; });
  if (trials_left > 0) {
    text += "and " + counted(summary.reasons.size() - shown, "other reason") + " of " +
            counted(static_cast<std::size_t>(trials_left), "trial") + "\n";
  }
  return text;
}

/// The columns of the rows, with the number of trials of each share: if only some scenes have
/// ground truth, trials of the other scenes are not judged.
Columns<SummaryRow> columns_with_trials() {
  Columns<SummaryRow> columns = row_columns();
  columns.add({"success_trials"}, [](const SummaryRow& row) { return row.success.trials; })
      .add({"agreement_trials"}, [](const SummaryRow& row) { return row.agreement.trials; });
  return columns;
}

/// The share, its interval, and the outcomes of the other trials.
View outcomes_view(const Table& table) {
  View view{{{"sensor"}}};
  const auto add = [&](const std::string& title, const std::string& content = "") {
    view.columns.push_back({title, content});
  };
  const std::vector<std::string> shares = share_names(table);
  for (const std::string& share : shares) {
    add(share, "<" + share + ">/<" + share + "_trials>");
    add("%", "<" + share + "_percent>");
    add("95 % interval", "[<" + share + "_low_percent>, <" + share + "_high_percent>]");
  }
  if (shares.front() == "success") add("inaccurate");
  add("rejected");
  add("failed");
  add_measures(view, kDistances, {"median", "p95"}, ", ");
  return view;
}

View frames_view() {
  return {{{"frames", "<success>/<scenes>"},
           {"%", "<success_ratio>"},
           {"95 % interval", "[<success_low_ratio>, <success_high_ratio>]"}},
          0};
}

/// The sections of the text.
class SummaryText {
 public:
  SummaryText(const Summary& summary, const TableStyle& style)
      : summary_(summary),
        style_(style),
        table_(columns_with_trials().table(summary.rows)),
        has_truth_(has_deviations_from(table_, DeviationsFrom::truth)),
        has_consensus_(has_deviations_from(table_, DeviationsFrom::consensus)),
        has_scenes_(any_row([](const SummaryRow& row) { return row.scenes.size() > 1; })),
        bounds_("within " + bounds_text(summary.bounds)) {
    const std::vector<std::string> shares = share_names(table_);
    share_ = shares.size() == 1 ? shares.front() : "success (no ground truth: agreement)";
  }

  std::string text() const {
    return definitions() + outcomes() + deviations() + comparisons() + by_scene() + agreed_poses() +
           reason_text(summary_, style_);
  }

 private:
  template <class Condition>
  bool any_row(const Condition& condition) const {
    return std::any_of(summary_.rows.begin(), summary_.rows.end(), condition);
  }

  /// A table of the degrees of freedom.
  std::string dofs(const std::vector<std::string>& statistics, const std::string& separator = "",
                   bool shows_each = false) const {
    View view{{{"sensor"}}};
    add_measures(view, kPaperOrder, statistics, separator);
    for (Shown& shown : view.columns) shown.shows_each = shows_each;
    return text_by_variant(table_, view, summary_, style_);
  }

  /// Explains the words and numbers below.
  std::string definitions() const {
    std::string text;
    if (has_truth_) text += "success: " + bounds_ + "ground truth; errors of these trials\n";
    if (has_consensus_) {
      text += "agreement (no ground truth): " + bounds_ +
              "the consensus of the scene's trials;\n  deviations of these trials from the "
              "consensus of all scenes\n";
    }
    return text + "rotation, translation: median, 95th percentile\n";
  }

  std::string outcomes() const {
    std::string text = "\n" + text_by_variant(table_, outcomes_view(table_), summary_, style_);
    if (any_row([](const SummaryRow& row) { return !main_share(row).interval; })) {
      text += "no interval: trials of one scene are dependent, and there are fewer than " +
              std::to_string(kMinScenes) + " scenes\n";
    }
    if (!has_scenes_ || summary_.frames.empty()) return text;
    return text + "\nframes: scenes in which every trial of every sensor succeeds\n" +
           text_by_variant(frame_columns().table(summary_.frames), frames_view(), summary_, style_);
  }

  std::string deviations() const {
    // Without ground truth deviations are from a mean of the trials, so their own means are zero.
    std::string text =
        has_truth_ ? "\nmean ± std\n" + dofs({"mean", "std"}, " ±") : "\nstd\n" + dofs({"std"});
    if (has_scenes_ && any_row([](const SummaryRow& row) { return !!row.within_scene_std; })) {
      text += "\nstd within scenes / across scenes\n" +
              dofs({"within_scene_std", "across_scenes_std"}, " / ", true);
    }
    return text;
  }

  std::string comparisons() const {
    if (summary_.comparisons.empty()) return "";
    std::string text = "\nagainst " + summary_.comparisons.front().base +
                       ", paired by trial: median difference [95 % interval over scenes], "
                       "failures are infinite errors\n";
    if (has_consensus_) {
      text +=
          "  (no ground truth: distances to the consensus of the variant's own trials of the "
          "scene, which\n  measure repeatability, not accuracy)\n";
    }
    return text + comparison_text(summary_, style_);
  }

  /// Loops, kinds of scenes, scenes.
  std::string by_scene() const {
    std::string text;
    if (!summary_.loops.empty()) {
      text += "\nloops: T_reference_target T_target_source " + bounds_ +
              "T_reference_source; deviations of loops from it\n" + loop_text(summary_, style_);
    }
    if (!summary_.scene_kinds.empty()) {
      text += "\nby kind of scene: " + share_ + " in %\n" + scene_kind_text(summary_, style_);
    }
    if (has_scenes_) text += "\n" + share_ + " per scene\n" + scene_text(summary_, style_);
    return text;
  }

  std::string agreed_poses() const {
    if (!has_consensus_) return "";
    std::string text = "\nresult: consensus T_reference_sensor of all scenes; agreeing: trials " +
                       bounds_ +
                       "it;\n  spread: their root mean square distance from it "
                       "(extrinsics.json)\n" +
                       agreed_text(summary_, style_);
    if (any_row([](const SummaryRow& row) { return lacks_truth(row) && !agreed_consensus(row); })) {
      text += "no pose: no two trials agree\n";
    }
    return text;
  }

  const Summary& summary_;
  const TableStyle& style_;
  Table table_;  ///< All rows; the views show parts of it.
  bool has_truth_;
  bool has_consensus_;
  bool has_scenes_;
  std::string bounds_;
  std::string share_;  ///< What the tables per scene and per kind show: "success" or "agreement".
};

}  // namespace

std::string summary_text(const Summary& summary, const TableStyle& style) {
  return summary.rows.empty() ? "no trials\n" : SummaryText(summary, style).text();
}

}  // namespace croon::experiments

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "experiments/report/export.hpp"
#include "experiments/report/result_sections.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {

namespace {

/// The number of shown reasons, the most frequent first, and of rows of the table per scene, the
/// worst of all.
constexpr std::size_t kMaxReasons = 5;
constexpr std::size_t kMaxSceneRows = 12;

/// The columns of the tables with a row per variant and sensor. Shares have their number of trials:
/// if only some scenes have ground truth, trials of the other scenes are not judged.
Columns<SummaryRow> row_columns() {
  Columns<SummaryRow> columns = export_columns();
  return columns.add({"inaccurate"}, [](const SummaryRow& row) { return row.outcomes.inaccurate; })
      .add({"rejected"}, [](const SummaryRow& row) { return row.outcomes.rejected; })
      .add({"failed"}, [](const SummaryRow& row) { return row.outcomes.failed; })
      .add({"success_trials"}, [](const SummaryRow& row) { return row.success.trials; })
      .add({"agreement_trials"}, [](const SummaryRow& row) { return row.agreement.trials; })
      .add(dof_columns("within_scene_std"), &SummaryRow::within_scene_std)
      .add(dof_columns("across_scenes_std"), &SummaryRow::across_scenes_std);
}

/// The corrected p value of a test, with its mark.
std::string p_text(const PairedTest& test) {
  const char* mark = is_significant_by_scene(test) ? "**" : is_significant(test) ? "*" : "";
  return (test.p_holm < 0.001 ? "<0.001" : fixed_number(test.p_holm, 3)) + mark;
}

/// A table of shares with a row per variant and name, and a column per title.
struct Pivot {
  Pivot(const std::string& name, const std::vector<std::string>& titles)
      : table{{{"variant"}, {name}}, {}}, view{{{name}}} {
    for (const std::string& title : titles) {
      // Titles such as sensors may coincide with names of other columns.
      view.columns.push_back({title, "<#" + std::to_string(table.columns.size()) + ">"});
      table.columns.push_back({title});
    }
  }

  /// The index of a row, which is added if it is new.
  std::size_t row(const std::string& variant, const std::string& name) {
    const auto [entry, is_new] = rows.insert({{variant, name}, table.rows.size()});
    if (is_new) {
      table.rows.push_back(cell_row(variant, nothing_if_empty(name)));
      table.rows.back().resize(table.columns.size());
    }
    return entry->second;
  }

  Table table;
  View view;
  std::map<std::pair<std::string, std::string>, std::size_t> rows;
};

/// The indices of the `count` lowest ranks, ascending.
std::vector<std::size_t> lowest_of(const std::vector<std::pair<double, double>>& ranks,
                                   std::size_t count) {
  std::vector<std::size_t> order(ranks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ranks[a] < ranks[b]; });
  order.resize(std::min(count, order.size()));
  std::sort(order.begin(), order.end());
  return order;
}

/// Builds the sections of a summary.
class SummarySections {
 public:
  explicit SummarySections(const Summary& summary)
      : summary_(summary),
        table_(row_columns().table(summary.rows)),
        sensors_(sensors_of(summary)),
        has_truth_(has_deviations_from(table_, DeviationsFrom::truth)),
        has_consensus_(has_deviations_from(table_, DeviationsFrom::consensus)),
        has_scenes_(any_row([](const SummaryRow& row) { return row.scenes.size() > 1; })),
        bounds_("within " + bounds_text(summary.bounds)) {
    if (!has_consensus_) share_ = "Success";
    if (!has_truth_) share_ = "Agreement";
  }

  /// The share, its interval, the outcomes of the other trials, and the distances.
  TableBlock outcomes() const {
    View view{{{"sensor"}}};
    for (const std::string& share : share_names(table_)) {
      view.columns.push_back({share, "<" + share + ">/<" + share + "_trials>"});
      view.columns.push_back({"%", "<" + share + "_percent>"});
      view.columns.push_back(
          {"95 % interval", "[<" + share + "_low_percent>, <" + share + "_high_percent>]"});
    }
    if (has_truth_) view.columns.push_back({"inaccurate"});
    view.columns.push_back({"rejected"});
    view.columns.push_back({"failed"});
    add_measures(view, kDistances, {"median", "p95"}, ", ");
    std::vector<std::string> notes = share_sentences(table_, summary_.bounds);
    notes.emplace_back("Rotation, translation: median, 95th percentile.");
    if (any_row([](const SummaryRow& row) { return !main_share(row).interval; })) {
      notes.push_back("No interval: trials of one scene are dependent, and there are fewer than " +
                      std::to_string(kMinScenes) + " scenes.");
    }
    return by_variant("", table_, view, notes);
  }

  std::vector<Section> sections() const {
    std::vector<Section> sections;
    const auto add = [&](const char* id, const std::string& title, TableBlock table) {
      sections.push_back({id, title, {std::move(table)}});
    };
    if (has_scenes_ && !summary_.frames.empty()) add("frames", "Frames", frames());
    // Without ground truth deviations are from a mean of the trials, so their own means are zero.
    if (has_truth_) {
      add("deviations", "Errors: mean ± std", dofs({"mean", "std"}, " ±"));
    } else {
      add("deviations", "Deviations: std", dofs({"std"}));
    }
    if (has_scenes_ && any_row([](const SummaryRow& row) { return !!row.within_scene_std; })) {
      add("spread", "Std within scenes / across scenes",
          dofs({"within_scene_std", "across_scenes_std"}, " / ", true));
    }
    if (!summary_.comparisons.empty()) {
      add("comparison", "Comparison with " + summary_.comparisons.front().base, comparisons());
    }
    if (!summary_.loops.empty()) add("loops", "Loops", loops());
    if (!summary_.scene_kinds.empty()) add("kinds", share_ + " by kind of scene, in %", kinds());
    if (has_scenes_) add("scenes", share_ + " per scene", scenes());
    if (has_consensus_) add("poses", "Poses on which the scenes agree", poses());
    if (!summary_.reasons.empty()) add("reasons", "Reported reasons", reasons());
    return sections;
  }

 private:
  template <class Condition>
  bool any_row(const Condition& condition) const {
    return std::any_of(summary_.rows.begin(), summary_.rows.end(), condition);
  }

  /// A table whose rows belong to variants, which are named if there are several.
  TableBlock by_variant(const std::string& caption, const Table& table, View view,
                        const std::vector<std::string>& notes = {}) const {
    if (variants_of(summary_).size() > 1) view.heading = "variant";
    return {caption, table, std::move(view), notes};
  }

  TableBlock frames() const {
    return by_variant("Scenes in which every trial of every sensor succeeds.",
                      frame_columns().table(summary_.frames),
                      {{{"frames", "<success>/<scenes>"},
                        {"%", "<success_ratio>"},
                        {"95 % interval", "[<success_low_ratio>, <success_high_ratio>]"}},
                       0});
  }

  /// A table of the degrees of freedom.
  TableBlock dofs(const std::vector<std::string>& statistics, const std::string& separator = "",
                  bool shows_each = false) const {
    View view{{{"sensor"}}};
    add_measures(view, kPaperOrder, statistics, separator);
    for (Shown& shown : view.columns) shown.shows_each = shows_each;
    return by_variant("", table_, view);
  }

  TableBlock comparisons() const {
    using C = Comparison;
    const auto difference = [](const ErrorComparison& error, std::size_t k) {
      return with_interval(error.paired_difference, error.paired_interval,
                           kMeasures[k].decimals + 1);
    };
    Columns<C> columns;
    columns.add({"variant"}, &C::variant)
        .add({"pairs"}, &C::pairs)
        .add({"won"}, &C::only_variant)
        .add({"lost"}, &C::only_base)
        .add({"p_success"}, [](const C& c) { return p_text(c.success); })
        .add({"rotation deg"}, [=](const C& c) { return difference(c.rotation_deg, kRotation); })
        .add({"p_rotation"}, [](const C& c) { return p_text(c.rotation_deg.test); })
        .add({"translation m"},
             [=](const C& c) { return difference(c.translation_m, kTranslation); })
        .add({"p_translation"}, [](const C& c) { return p_text(c.translation_m.test); });
    const View view{{{"pairs"},
                     {"won"},
                     {"lost"},
                     {"p", "<p_success>"},
                     {"rotation deg"},
                     {"p", "<p_rotation>"},
                     {"translation m"},
                     {"p", "<p_translation>"}},
                    0};
    std::vector<std::string> notes = {
        "* p < 0.05 over trials (McNemar, Wilcoxon; Holm), ** also with scenes as units."};
    if (has_consensus_) {
      notes.emplace_back(
          "No ground truth: distances to the consensus of the variant's own trials of the scene, "
          "which measure repeatability, not accuracy.");
    }
    return by_variant(
        "Paired by trial: median difference [95 % interval over scenes]; failures are infinite "
        "errors.",
        columns.table(of_all_sensors(summary_.comparisons)), view, notes);
  }

  TableBlock loops() const {
    View view{{{"loop", "<pair>"},
               {"closed", "<closed>/<loops>"},
               {"%", "<closed_ratio>"},
               {"95 % interval", "[<closed_low_ratio>, <closed_high_ratio>]"}}};
    add_measures(view, kDistances, {"median", "p95"}, ", ");
    view.columns.push_back({"scenes", "<scenes_closed>/<scenes>"});
    view.columns.push_back({"agreed deg, m", "<agreed_rotation_deg>, <agreed_translation_m>"});
    return by_variant("", loop_columns().table(summary_.loops), view,
                      {"Closed: T_reference_target T_target_source " + bounds_ +
                           "T_reference_source; deviations of loops from it.",
                       "Scenes: loops over each scene's consensus that close; agreed: the loop "
                       "over the consensus of all scenes."});
  }

  std::size_t index_of_sensor(const std::string& sensor) const {
    const auto found = std::find(sensors_.begin(), sensors_.end(), sensor);
    return static_cast<std::size_t>(found - sensors_.begin());
  }

  /// Success in % per variant, kind of scene (rows) and sensor (columns).
  TableBlock kinds() const {
    std::vector<std::string> titles = sensors_;
    titles.insert(titles.begin(), {"scenes", "trials", kAllSensors});
    Pivot pivot("kind", titles);
    for (const SceneKindSummary& kind : summary_.scene_kinds) {
      CellRow& cells = pivot.table.rows[pivot.row(kind.variant, kind.scene_kind)];
      const bool is_of_all = kind.sensor.empty();
      cells[is_of_all ? 4 : 5 + index_of_sensor(kind.sensor)] = {100.0 * main_share(kind).ratio, 1};
      if (!is_of_all) continue;
      cells[2] = to_cell(kind.scene_count);
      cells[3] = to_cell(kind.outcomes.trials);
    }
    return by_variant("", pivot.table, pivot.view);
  }

  /// Success per variant, scene (rows) and sensor (columns). Of many rows the worst are shown, in
  /// their original order: by the minimum success over sensors, then by the sum.
  TableBlock scenes() const {
    Pivot pivot("scene", sensors_);
    std::vector<std::pair<double, double>> ranks;
    for (const SummaryRow& row : summary_.rows) {
      for (const SceneSummary& scene : row.scenes) {
        const std::size_t i = pivot.row(row.variant, scene.scene);
        ranks.resize(pivot.table.rows.size(), {std::numeric_limits<double>::infinity(), 0.0});
        if (!is_judged_as(row, scene)) continue;
        const Share& share = main_share(scene);
        pivot.table.rows[i][2 + index_of_sensor(row.sensor)] =
            to_cell(std::to_string(share.count) + "/" + std::to_string(share.trials));
        ranks[i] = {std::min(ranks[i].first, share.ratio), ranks[i].second + share.ratio};
      }
    }
    Table shown{pivot.table.columns, {}};
    for (const std::size_t i : lowest_of(ranks, kMaxSceneRows)) {
      shown.rows.push_back(pivot.table.rows[i]);
    }
    std::vector<std::string> notes;
    if (shown.rows.size() < ranks.size()) {
      notes = {"The worst " + std::to_string(shown.rows.size()) + " of " +
               std::to_string(ranks.size()) + " rows."};
    }
    return by_variant("", shown, pivot.view, notes);
  }

  /// The poses that all scenes agree on, for rows without ground truth.
  TableBlock poses() const {
    Columns<SummaryRow> columns;
    columns.add({"variant"}, &SummaryRow::variant)
        .add({"sensor"}, &SummaryRow::sensor)
        .add(agreed_pose_columns(), [](const SummaryRow& row) { return agreed_pose(row); });
    std::vector<SummaryRow> rows;
    std::copy_if(summary_.rows.begin(), summary_.rows.end(), std::back_inserter(rows), lacks_truth);
    const View view{{{"sensor"},
                     {"x m", "<tx_m>"},
                     {"y m", "<ty_m>"},
                     {"z m", "<tz_m>"},
                     {"roll deg", "<roll_deg>"},
                     {"pitch deg", "<pitch_deg>"},
                     {"yaw deg", "<yaw_deg>"},
                     {"agreeing", "<agreeing>/<trials>"},
                     {"spread deg, m", "<spread_deg>, <spread_m>"}}};
    std::vector<std::string> notes = {"Agreeing: trials " + bounds_ +
                                      "it; spread: their root mean square distance from it."};
    if (std::any_of(rows.begin(), rows.end(),
                    [](const SummaryRow& row) { return !agreed_consensus(row); })) {
      notes.emplace_back("No pose: no two trials agree.");
    }
    return by_variant("Consensus T_reference_sensor of all scenes (extrinsics.json).",
                      columns.table(rows), view, notes);
  }

  TableBlock reasons() const {
    const std::vector<ReasonCount>& all = summary_.reasons;
    const auto shown = static_cast<std::ptrdiff_t>(std::min(kMaxReasons, all.size()));
    View view{{{"status"}, {"reason"}, {"trials", "<count>"}}, 2};
    view.max_name_columns = 80;
    std::vector<std::string> notes;
    if (const std::size_t others = all.size() - static_cast<std::size_t>(shown); others > 0) {
      std::size_t trials = 0;
      for (auto r = all.begin() + shown; r != all.end(); ++r) trials += std::size_t(r->count);
      notes = {"And " + counted(others, "other reason") + " of " + counted(trials, "trial") + "."};
    }
    return by_variant("", reason_columns().table({all.begin(), all.begin() + shown}), view, notes);
  }

  const Summary& summary_;
  Table table_;  ///< All rows; the views show parts of it.
  std::vector<std::string> sensors_;
  bool has_truth_;
  bool has_consensus_;
  bool has_scenes_;
  std::string bounds_;
  /// What the tables per scene and per kind show.
  std::string share_ = "Success (no ground truth: agreement)";
};

}  // namespace

Section summary_section(const Results& results) {
  Section section{"summary", "Results", {}};
  if (results.scenes_per_trial > 1) {
    section.blocks.emplace_back(Paragraph{"Each trial calibrates the rig from " +
                                          std::to_string(results.scenes_per_trial) +
                                          " scenes; a \"scene\" below is such a group."});
  }
  if (results.summary.rows.empty()) {
    section.blocks.emplace_back(Paragraph{"no trials"});
    return section;
  }
  const SummarySections parts(results.summary);
  section.blocks.emplace_back(parts.outcomes());
  section.sections = parts.sections();
  return section;
}

}  // namespace croon::experiments

#include "experiments/report/export.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "experiments/report/build_text.hpp"
#include "experiments/report/export_choice.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

namespace {

constexpr const char* kSuccessColumn = "success_percent";
constexpr const char* kAgreementColumn = "agreement_percent";

/// A row with its comparison with the base; null if there is none.
struct ComparedRow : SummaryRow {
  const Comparison* comparison = nullptr;
};

/// The comparison of a distance; null without ground truth, where it tests repeatability, which no
/// column shows.
const ErrorComparison* compared_error(const ComparedRow& row, std::size_t measure) {
  if (row.comparison == nullptr || row.deviations_from != DeviationsFrom::truth) return nullptr;
  return measure == kRotation ? &row.comparison->rotation_deg : &row.comparison->translation_m;
}

/// The paired differences of the distances from the base, with their intervals. One digit more than
/// the medians, which may be equal.
Columns<ComparedRow> paired_columns() {
  using E = ErrorComparison;
  Columns<ComparedRow> columns;
  for (const std::size_t k : kDistances) {
    const auto add = [&](const std::string& what, auto value) {
      Column column = statistic_column(kMeasures[k], "paired_" + what);
      column.better = Better::neither;
      ++column.decimals;
      columns.add(column, [k, value](const ComparedRow& row) {
        const E* const error = compared_error(row, k);
        return error ? std::optional<double>(std::invoke(value, *error)) : std::nullopt;
      });
    };
    add("difference", &E::paired_difference);
    add("low", [](const E& error) { return low_of(error.paired_interval); });
    add("high", [](const E& error) { return high_of(error.paired_interval); });
  }
  return columns;
}

/// The index of the column with the share of a row: success, or agreement without ground truth.
std::size_t share_column(const Table& table, std::size_t row) {
  const bool lacks_truth = table.text_at(row, "reference") == name_of(DeviationsFrom::consensus);
  return table.index_of(lacks_truth ? kAgreementColumn : kSuccessColumn);
}

/// Adds a share in percent and the ends of its interval; `share` returns null for a row without it.
template <class F>
void add_percents(Columns<SummaryRow>& columns, const std::string& name, F share) {
  columns.add({name, "percent", "", 1, Better::greater}, [=](const SummaryRow& row) {
    const Share* const found = share(row);
    return found ? std::optional<double>(100.0 * found->ratio) : std::nullopt;
  });
  const auto add_end = [&](const std::string& end, double Interval::*value) {
    columns.add({name + end, "percent", "", 1}, [=](const SummaryRow& row) {
      const Share* const found = share(row);
      const bool is_known = found && found->interval;
      return is_known ? std::optional<double>(100.0 * ((*found->interval).*value)) : std::nullopt;
    });
  };
  add_end("_low", &Interval::low);
  add_end("_high", &Interval::high);
}

template <class Row>
void add_statistic(Columns<Row>& columns, std::size_t k, std::size_t s) {
  columns.add(statistic_column(kMeasures[k], kStatistics[s].name),
              [k, s](const Row& row) { return value_of(row.statistics, k, s); });
}

/// Smaller is better. Computed from the displayed digits, so that equal numbers are either all bold
/// or all plain.
double rank(const Cell& cell, const Column& column) {
  const std::string text = shown_text(cell, column);
  double shown = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), shown);
  return column.better == Better::greater ? -shown : std::abs(shown);
}

/// Marks the best of each column among the rows [begin, end) of one sensor; `below` are the
/// variants whose success is significantly or clearly below the best.
void mark_best(Table& table, std::size_t begin, std::size_t end,
               const std::set<VariantSensor>& below) {
  const std::size_t success = share_column(table, begin);
  const auto sign = [&](std::size_t row, std::size_t k) {
    const std::string& mark = table.rows[row][k].mark;
    return mark.empty() ? ' ' : mark[0];
  };
  bool one_beats_base = false;
  for (std::size_t i = begin; i < end; ++i) {
    one_beats_base = one_beats_base || sign(i, success) == '+';
  }
  // If a row succeeds significantly less often than another, its errors are over easier trials. If
  // another row beats the base, this also holds for a row that does not differ from the base.
  const auto is_of_easier_trials = [&](std::size_t row) {
    return sign(row, success) == '-' || (sign(row, success) == ' ' && one_beats_base) ||
           below.count({table.text_at(row, "variant"), table.text_at(row, "sensor")}) > 0;
  };
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const Column& column = table.columns[k];
    if (column.better == Better::neither) continue;
    // Without ground truth, deviations measure repeatability, not accuracy.
    const bool is_error = column.better != Better::greater;
    if (is_error && table.text_at(begin, "reference") != name_of(DeviationsFrom::truth)) continue;
    std::vector<Cell*> rivals;
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = begin; i < end; ++i) {
      Cell& cell = table.rows[i][k];
      if (cell.is_nothing() || sign(i, k) == '-') continue;
      if (k != success && is_of_easier_trials(i)) continue;
      rivals.push_back(&cell);
      best = std::min(best, rank(cell, column));
    }
    for (Cell* cell : rivals) cell->is_best = rank(*cell, column) == best;
  }
}

void mark_best_of_each_sensor(Table& table, const std::set<VariantSensor>& below) {
  for (std::size_t begin = 0, end = 0; begin < table.rows.size(); begin = end) {
    while (end < table.rows.size() &&
           table.text_at(end, "sensor") == table.text_at(begin, "sensor")) {
      ++end;
    }
    mark_best(table, begin, end, below);
  }
}

std::string mark_of(const PairedTest& test) {
  if (!is_significant(test)) return "";
  return std::string(test.favours_variant ? "+" : "-") +
         (is_significant_by_scene(test) ? "**" : "*");
}

/// Marks the rows, which are those of `table`, where they differ from the base.
void set_marks(Table& table, const std::vector<ComparedRow>& rows) {
  const auto median = [&](std::size_t k) {
    return table.index_of(statistic_column(kMeasures[k], "median").full_name());
  };
  for (const std::size_t column : {table.index_of(kSuccessColumn), table.index_of(kAgreementColumn),
                                   median(kRotation), median(kTranslation)}) {
    table.columns[column].has_marks = true;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].comparison == nullptr) continue;
    table.rows[i][share_column(table, i)].mark = mark_of(rows[i].comparison->success);
    for (const std::size_t k : kDistances) {
      const ErrorComparison* const error = compared_error(rows[i], k);
      if (error != nullptr) table.rows[i][median(k)].mark = mark_of(error->test);
    }
  }
}

/// The range of the numbers in a column: "48", or "12 to 48".
std::string range_text(const Table& table, const std::string& column) {
  std::vector<long long> numbers;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    numbers.push_back(std::get<long long>(table.at(i, column).value));
  }
  const auto [min, max] = std::minmax_element(numbers.begin(), numbers.end());
  const std::string text = std::to_string(*min);
  return *min == *max ? text : text + " to " + std::to_string(*max);
}

/// "2 scenes, 4 sensors, 2 variants, 10 starts of each: 160 trials; a row has 80 of 2 scenes."
std::string counts_sentence(const ExportTable& table) {
  const ExportCaption& caption = table.caption;
  std::string kinds;
  for (const std::string& kind : caption.kinds) kinds += (kinds.empty() ? " of " : ", ") + kind;
  const bool has_groups = caption.scenes_per_trial > 1;
  const std::string unit = has_groups ? "group" : "scene";
  std::string text = counted(caption.scenes, unit);
  if (has_groups) text += " of " + std::to_string(caption.scenes_per_trial) + " scenes";
  text += kinds + ", " + counted(table.sensors.size(), "sensor") + ", ";
  if (table.variants.size() > 1) text += counted(table.variants.size(), "variant") + ", ";
  text += counted(static_cast<std::size_t>(caption.starts), "start") + " of each: ";
  if (caption.found < caption.planned) text += std::to_string(caption.found) + " of ";
  text += counted(caption.planned, "trial");
  if (table.table.rows.empty()) return text + ".";
  const std::string scenes = range_text(table.table, "scenes");
  return text + "; a row has " + range_text(table.table, "trials") + " of " + scenes +
         (scenes == "1" ? " " + unit + "." : " " + unit + "s.");
}

/// The sentences of all experiments, each once, beginning with those that name the experiments.
std::vector<std::string> joined_sentences(const ExportTable& table) {
  std::vector<std::string> names, others;
  for (const ExportTable& part : table.parts) {
    const std::vector<std::string> sentences = caption_sentences(part);
    names.insert(names.end(), sentences.begin(), sentences.begin() + 2);
    for (std::size_t i = 2; i < sentences.size(); ++i) {
      if (std::find(others.begin(), others.end(), sentences[i]) == others.end()) {
        others.push_back(sentences[i]);
      }
    }
  }
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

}  // namespace

Columns<SummaryRow> export_columns() {
  Columns<SummaryRow> columns;
  columns.add({"variant"}, &SummaryRow::variant);
  add_sensor(columns);
  columns.add({"reference"}, [](const SummaryRow& row) { return name_of(row.deviations_from); })
      .add({"scenes"}, &SummaryRow::scene_count)
      .add({"trials"}, [](const SummaryRow& row) { return row.outcomes.trials; })
      .add({"success"},
           [](const SummaryRow& row) {
             return lacks_truth(row) ? std::nullopt : std::optional<int>(row.success.count);
           })
      .add({"counted"}, &SummaryRow::counted);
  add_percents(columns, "success",
               [](const SummaryRow& row) { return lacks_truth(row) ? nullptr : &row.success; });
  columns.add({"agreement"}, [](const SummaryRow& row) {
    const Share* const share = agreement_of(row);
    return share ? std::optional<int>(share->count) : std::nullopt;
  });
  add_percents(columns, "agreement", [](const SummaryRow& row) { return agreement_of(row); });
  for (const std::size_t k : kDistances) {
    add_statistic(columns, k, statistic_index("median"));
    add_statistic(columns, k, statistic_index("p95"));
  }
  for (const std::size_t k : kPaperOrder) {
    add_statistic(columns, k, statistic_index("mean"));
    add_statistic(columns, k, statistic_index("std"));
  }
  return columns;
}

ExportTable export_table(const Summary& summary, const ExportCaption& caption) {
  return export_table(summary, caption, {});
}

ExportTable export_table(const Summary& summary, const ExportCaption& caption,
                         const TableChoice& choice) {
  ExportTable table{caption, summary.bounds, "", variants_of(summary), sensors_of(summary), {}};
  std::vector<ComparedRow> rows;
  const auto add = [&](const SummaryRow& row) {
    rows.push_back({row, nullptr});
    for (const Comparison& comparison : summary.comparisons) {
      const bool is_of_row = comparison.variant == row.variant && comparison.sensor == row.sensor;
      if (is_of_row) rows.back().comparison = &comparison;
    }
  };
  for (const std::string& sensor : table.sensors) {
    for (const SummaryRow& row : summary.rows) {
      if (row.sensor == sensor) add(row);
    }
  }
  if (table.sensors.size() > 1) {
    for (const std::string& variant : table.variants) {
      SummaryRow all;
      static_cast<TrialSummary&>(all) = pooled(scenes_of(rows_of(summary, variant)));
      all.variant = variant;
      add(all);
    }
  }
  Columns<ComparedRow> columns;
  columns.add(export_columns()).add(paired_columns());
  // A duplicate column does no harm, because columns are found by name.
  for (std::size_t k = 0; !choice.columns.empty() && k < kMeasures.size(); ++k) {
    for (std::size_t s = 0; s < kStatistics.size(); ++s) add_statistic(columns, k, s);
  }
  table.table = columns.table(rows);
  if (!summary.comparisons.empty()) table.base = summary.comparisons.front().base;
  set_marks(table.table, rows);
  if (table.variants.size() > 1) mark_best_of_each_sensor(table.table, summary.below_best);
  choose(table, choice);
  return table;
}

std::vector<std::string> share_sentences(const Table& table, const SuccessBounds& of_success) {
  std::vector<std::string> sentences;
  const std::string bounds = "within " + bounds_text(of_success);
  if (has_deviations_from(table, DeviationsFrom::truth)) {
    sentences.push_back("Success: " + bounds + "ground truth; errors are over these trials.");
  }
  if (has_deviations_from(table, DeviationsFrom::consensus)) {
    sentences.push_back("Agreement (no ground truth): " + bounds +
                        "the consensus of the scene's trials; deviations of these trials are from "
                        "the consensus of all scenes.");
  }
  return sentences;
}

std::vector<std::string> caption_sentences(const ExportTable& table) {
  if (!table.parts.empty()) return joined_sentences(table);
  std::vector<std::string> sentences = {table.caption.name + " (croon, commit " +
                                            short_commit(table.caption.commit) + ", seed " +
                                            std::to_string(table.caption.seed) + ").",
                                        counts_sentence(table)};
  const std::vector<std::string>& builds = table.caption.builds;
  sentences.insert(sentences.end(), builds.begin(), builds.end());
  for (const std::string& sentence : share_sentences(table.table, table.bounds)) {
    sentences.push_back(sentence);
  }
  if (shows(table, kShareInterval)) {
    sentences.push_back("Interval: 95 %, over scenes (Wilson); requires at least " +
                        std::to_string(kMinScenes) + " scenes.");
  }
  if (table.variants.size() > 1) {
    // The complete rule of `mark_best`.
    const bool has_marks = !table.base.empty();
    sentences.push_back(
        std::string("Bold: the best value of the sensor") +
        (has_marks ? " not marked -; for errors among variants whose success is not marked -, "
                     "is marked + if any is, and is neither"
                   : "; for errors among variants whose success is neither") +
        " more than 5 points nor significantly below the best; deviations without ground truth are "
        "never bold.");
  }
  if (!table.base.empty()) {
    const bool has_paired = shows(table, kPairedInterval);
    sentences.push_back(
        "*: differs from " + table.base +
        " over the same trials, with infinite errors for trials without a usable result (McNemar, "
        "Wilcoxon; p < 0.05 after Holm correction over the variants of this table): + better, - "
        "worse; **: also with scenes "
        "as units." +
        (has_paired ? " Paired: 95 % interval of the median paired difference, over scenes." : ""));
  }
  return sentences;
}

std::string export_csv(const ExportTable& table) { return csv_table(table.table); }

std::string export_json(const ExportTable& table) {
  if (!table.parts.empty()) {
    nlohmann::ordered_json experiments = nlohmann::ordered_json::array();
    for (const ExportTable& part : table.parts) {
      experiments.push_back(nlohmann::ordered_json::parse(export_json(part)));
    }
    return json_bytes({{"caption", caption_sentences(table)}, {"experiments", experiments}});
  }
  const ExportCaption& caption = table.caption;
  return json_bytes({{"name", caption.name},
                     {"commit", caption.commit},
                     {"seed", caption.seed},
                     {"scenes", caption.scenes},
                     {"scenes_per_trial", caption.scenes_per_trial},
                     {"sensors", table.sensors.size()},
                     {"starts", caption.starts},
                     {"trials", caption.found},
                     {"planned", caption.planned},
                     {"success_bounds",
                      {{"rotation_deg", table.bounds.rotation_deg},
                       {"translation_m", table.bounds.translation_m}}},
                     {"caption", caption_sentences(table)},
                     {"rows", json_rows(table.table)}});
}

namespace {

/// "x (m) p95", or in the full table "x p95 m".
std::string markdown_title(const ExportColumn& column, bool is_full) {
  if (column.subject.empty()) return column.statistic;
  if (!is_full) return column.group() + " " + column.statistic;
  if (column.statistic == kShareInterval) return column.statistic;
  const bool is_obvious = column.statistic == "rate" || column.statistic == kMeanAndStd;
  return column.subject + " " + (is_obvious ? "" : column.statistic + " ") + column.unit;
}

std::string markdown_content(const ExportColumn& column) {
  const std::string first = "<" + column.columns.front() + ">";
  const std::string last = "<" + column.columns.back() + ">";
  if (column.columns.size() == 1) return first;
  return column.statistic == kMeanAndStd ? first + " ± " + last : "[" + first + ", " + last + "]";
}

}  // namespace

std::string export_markdown(const ExportTable& table) {
  std::string text;
  for (const std::string& sentence : caption_sentences(table)) {
    text += markdown_escaped(sentence) + "\n";
  }
  const bool is_full = table.chosen.empty();
  if (is_full) text += "Degrees of freedom: mean ± std.\n";
  View view;
  if (!table.parts.empty()) view.columns.push_back({"experiment"});
  view.columns.push_back({"variant"});
  view.columns.push_back({"sensor"});
  view.names = view.columns.size();
  for (const ExportColumn& column : shown_columns(table)) {
    view.columns.push_back({markdown_title(column, is_full), markdown_content(column)});
  }
  return text + "\n" + markdown_table(table.table, view);
}

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {{"csv", false, export_csv},
                                                    {"json", false, export_json},
                                                    {"latex", true, export_latex},
                                                    {"md", false, export_markdown}};
  return formats;
}

}  // namespace croon::experiments

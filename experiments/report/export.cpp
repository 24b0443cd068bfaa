#include "experiments/report/export.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "framework/base/text.hpp"

namespace croon::experiments {

namespace {

constexpr const char* kSuccessColumn = "success_percent";

/// The columns with marks, and the tests that these are of.
struct MarkedColumn {
  const char* name;
  const PairedTest& (*test)(const Comparison& comparison);
  bool needs_truth;  ///< Without truth the test is of repeatability, which no column shows.
};

const std::vector<MarkedColumn>& marked_columns() {
  using C = Comparison;
  static const std::vector<MarkedColumn> columns = {
      {kSuccessColumn, [](const C& c) -> const PairedTest& { return c.success; }, false},
      {"rotation_median_deg", [](const C& c) -> const PairedTest& { return c.rotation_deg.test; },
       true},
      {"translation_median_m", [](const C& c) -> const PairedTest& { return c.translation_m.test; },
       true}};
  return columns;
}

/// All sensors of a variant as one row, without scenes.
SummaryRow all_sensors(const Summary& summary, const std::string& variant) {
  SummaryRow all;
  static_cast<TrialSummary&>(all) = pooled(scenes_of(rows_of(summary, variant)));
  all.variant = variant;
  return all;
}

/// Less is better. Of the digits that are shown: a reader who sees two equal numbers, one of them
/// bold, would look for a reason.
double rank(const Cell& cell, const Column& column) {
  if (cell.is_nothing()) return std::numeric_limits<double>::infinity();
  const std::string text = shown_text(cell, column);
  double shown = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), shown);
  return column.better == Better::greater ? -shown : std::abs(shown);
}

/// Marks the best of each column among the rows [begin, end) of one sensor.
class Ranking {
 public:
  Ranking(Table& table, std::size_t begin, std::size_t end)
      : table_(table), begin_(begin), end_(end), success_(table.index_of(kSuccessColumn)) {}

  void mark_best() {
    for (std::size_t k = 0; k < table_.columns.size(); ++k) {
      if (table_.columns[k].better != Better::neither) mark_best(k);
    }
  }

 private:
  void mark_best(std::size_t k) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = begin_; i < end_; ++i) {
      if (is_rival(i, k)) best = std::min(best, rank(table_.rows[i][k], table_.columns[k]));
    }
    for (std::size_t i = begin_; i < end_; ++i) {
      Cell& cell = table_.rows[i][k];
      cell.is_best = is_rival(i, k) && rank(cell, table_.columns[k]) == best;
    }
  }

  bool is_rival(std::size_t row, std::size_t k) const {
    const Cell& cell = table_.rows[row][k];
    const bool is_worse_than_base = !cell.mark.empty() && cell.mark[0] == '-';
    if (cell.is_nothing() || is_worse_than_base) return false;
    return k == success_ || !is_of_easier_trials(row);
  }

  /// Whether the row succeeds significantly less often than another: its errors are then those of
  /// the easier trials.
  bool is_of_easier_trials(std::size_t row) const {
    if (sign(row) != ' ') return sign(row) == '-';
    // Neither better nor worse than the base: worse than what is better than the base.
    for (std::size_t i = begin_; i < end_; ++i) {
      if (sign(i) == '+') return true;
    }
    return false;
  }

  char sign(std::size_t row) const {
    const std::string& mark = table_.rows[row][success_].mark;
    return mark.empty() ? ' ' : mark[0];
  }

  Table& table_;
  std::size_t begin_;
  std::size_t end_;
  std::size_t success_;
};

void mark_best_of_each_sensor(Table& table) {
  for (std::size_t begin = 0, end = 0; begin < table.rows.size(); begin = end) {
    while (end < table.rows.size() &&
           table.text_at(end, "sensor") == table.text_at(begin, "sensor")) {
      ++end;
    }
    Ranking(table, begin, end).mark_best();
  }
}

std::string mark_of(const PairedTest& test) {
  if (!is_significant(test)) return "";
  return std::string(test.favours_variant ? "+" : "-") + (holds_by_scene(test) ? "**" : "*");
}

void set_marks(Table& table, const std::vector<Comparison>& comparisons) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    for (const Comparison& comparison : comparisons) {
      if (comparison.variant != table.text_at(i, "variant")) continue;
      if (comparison.sensor != table.text_at(i, "sensor")) continue;
      const bool has_truth = table.text_at(i, "reference") == name_of(DeviationsFrom::truth);
      for (const MarkedColumn& marked : marked_columns()) {
        if (marked.needs_truth && !has_truth) continue;
        table.rows[i][table.index_of(marked.name)].mark = mark_of(marked.test(comparison));
      }
    }
  }
}

/// The first digits of a commit; the suffix "-dirty" stays.
std::string short_commit(const std::string& commit) {
  constexpr std::size_t kShownDigits = 12;
  const std::size_t dash = std::min(commit.find('-'), commit.size());
  return commit.substr(0, std::min(dash, kShownDigits)) + commit.substr(dash);
}

/// "2 scenes, 4 sensors, 2 variants, 10 starts of each: 160 trials."
std::string counts_sentence(const ExportTable& table) {
  const ExportCaption& caption = table.caption;
  std::string text =
      counted(caption.scenes, "scene") + ", " + counted(table.sensors.size(), "sensor") + ", ";
  if (table.variants.size() > 1) text += counted(table.variants.size(), "variant") + ", ";
  text += counted(static_cast<std::size_t>(caption.starts), "start") + " of each: ";
  if (caption.found < caption.planned) text += std::to_string(caption.found) + " of ";
  return text + counted(caption.planned, "trial") + ".";
}

bool has_deviations_from(const Table& table, DeviationsFrom from) {
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.text_at(i, "reference") == name_of(from)) return true;
  }
  return false;
}

}  // namespace

Columns<SummaryRow> export_columns() {
  Columns<SummaryRow> columns;
  columns.add({"variant"}, &SummaryRow::variant);
  add_sensor(columns);
  columns.add({"reference"}, [](const SummaryRow& row) { return name_of(row.deviations_from); })
      .add({"trials"}, [](const SummaryRow& row) { return row.outcomes.trials; })
      .add({"success"}, [](const SummaryRow& row) { return main_share(row).count; })
      .add({"counted"}, &SummaryRow::counted)
      .add({"success", "percent", "", 1, Better::greater},
           [](const SummaryRow& row) { return 100.0 * main_share(row).ratio; })
      .add({"success_low", "percent", "", 1},
           [](const SummaryRow& row) { return 100.0 * main_share(row).interval.low; })
      .add({"success_high", "percent", "", 1},
           [](const SummaryRow& row) { return 100.0 * main_share(row).interval.high; });
  std::vector<std::string> names;
  for (const std::size_t k : {kRotation, kTranslation}) {
    names.push_back(column_name(kMeasures[k], "median"));
    names.push_back(column_name(kMeasures[k], "p95"));
  }
  for (const std::size_t k : kPaperOrder) {
    names.push_back(column_name(kMeasures[k], "mean"));
    names.push_back(column_name(kMeasures[k], "std"));
  }
  columns.add(statistics_columns().selected(names), &SummaryRow::statistics);
  for (const std::string& name : names) columns.column(name).path.clear();
  for (const MarkedColumn& marked : marked_columns()) columns.column(marked.name).has_marks = true;
  return columns;
}

ExportTable export_table(const Summary& summary, const ExportCaption& caption) {
  ExportTable table{caption, summary.bounds, "", variants_of(summary), sensors_of(summary), {}};
  std::vector<SummaryRow> rows;
  for (const std::string& sensor : table.sensors) {
    for (const SummaryRow& row : summary.rows) {
      if (row.sensor == sensor) rows.push_back(row);
    }
  }
  if (table.sensors.size() > 1) {
    for (const std::string& variant : table.variants) {
      rows.push_back(all_sensors(summary, variant));
    }
  }
  table.table = export_columns().table(rows);
  table.table.is_ranked = true;
  if (!summary.comparisons.empty()) table.base = summary.comparisons.front().base;
  set_marks(table.table, summary.comparisons);
  if (table.variants.size() > 1) mark_best_of_each_sensor(table.table);
  return table;
}

std::vector<std::string> caption_sentences(const ExportTable& table) {
  std::vector<std::string> sentences = {table.caption.name + " (croon, commit " +
                                            short_commit(table.caption.commit) + ", seed " +
                                            std::to_string(table.caption.seed) + ").",
                                        counts_sentence(table)};
  const std::string bounds = "within " + bounds_text(table.bounds);
  if (has_deviations_from(table.table, DeviationsFrom::truth)) {
    sentences.push_back("Success: " + bounds + "the truth; errors are those of these trials.");
  }
  if (has_deviations_from(table.table, DeviationsFrom::consensus)) {
    sentences.push_back("Success, where there is no truth: " + bounds +
                        "what the trials of the scene agree on; deviations of these trials from "
                        "what all scenes agree on.");
  }
  sentences.emplace_back("Interval: 95 % (Wilson).");
  if (table.variants.size() > 1) {
    sentences.emplace_back(
        "Bold: the best of the sensor, for errors among those that no other beats in success.");
  }
  if (!table.base.empty()) {
    sentences.push_back("*: differs from " + table.base +
                        " over the same trials, those without a usable result as infinite errors "
                        "(McNemar, Wilcoxon; p < 0.05 after Holm), + for the better, - for the "
                        "worse; **: also with scenes as units.");
  }
  return sentences;
}

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {"csv", export_csv}, {"json", export_json}, {"latex", export_latex}, {"md", export_markdown}};
  return formats;
}

}  // namespace croon::experiments

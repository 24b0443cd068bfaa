#include "experiments/report/export.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "experiments/report/build_text.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

namespace {

/// The columns with marks.
constexpr const char* kSuccessColumn = "success_percent";
constexpr const char* kRotationColumn = "rotation_median_deg";
constexpr const char* kTranslationColumn = "translation_median_m";

/// Less is better. Of the digits that are shown: a reader who sees two equal numbers, one of them
/// bold, would look for a reason.
double rank(const Cell& cell, const Column& column) {
  const std::string text = shown_text(cell, column);
  double shown = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), shown);
  return column.better == Better::greater ? -shown : std::abs(shown);
}

/// Marks the best of each column among the rows [begin, end) of one sensor.
void mark_best(Table& table, std::size_t begin, std::size_t end) {
  const std::size_t success = table.index_of(kSuccessColumn);
  const auto sign = [&](std::size_t row, std::size_t k) {
    const std::string& mark = table.rows[row][k].mark;
    return mark.empty() ? ' ' : mark[0];
  };
  bool one_beats_base = false;
  for (std::size_t i = begin; i < end; ++i) {
    one_beats_base = one_beats_base || sign(i, success) == '+';
  }
  // If a row succeeds significantly less often than another, its errors are those of the easier
  // trials. What is neither better nor worse than the base is worse than what beats the base.
  const auto is_of_easier_trials = [&](std::size_t row) {
    return sign(row, success) == '-' || (sign(row, success) == ' ' && one_beats_base);
  };
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const Column& column = table.columns[k];
    if (column.better == Better::neither) continue;
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

void mark_best_of_each_sensor(Table& table) {
  for (std::size_t begin = 0, end = 0; begin < table.rows.size(); begin = end) {
    while (end < table.rows.size() &&
           table.text_at(end, "sensor") == table.text_at(begin, "sensor")) {
      ++end;
    }
    mark_best(table, begin, end);
  }
}

std::string mark_of(const PairedTest& test) {
  if (!is_significant(test)) return "";
  return std::string(test.favours_variant ? "+" : "-") + (holds_by_scene(test) ? "**" : "*");
}

void set_marks(Table& table, const std::vector<Comparison>& comparisons) {
  for (const char* name : {kSuccessColumn, kRotationColumn, kTranslationColumn}) {
    table.columns[table.index_of(name)].has_marks = true;
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto mark = [&](const char* column, const PairedTest& test) {
      table.rows[i][table.index_of(column)].mark = mark_of(test);
    };
    for (const Comparison& comparison : comparisons) {
      if (comparison.variant != table.text_at(i, "variant")) continue;
      if (comparison.sensor != table.text_at(i, "sensor")) continue;
      mark(kSuccessColumn, comparison.success);
      // Without truth these are tests of repeatability, which no column shows.
      if (table.text_at(i, "reference") != name_of(DeviationsFrom::truth)) continue;
      mark(kRotationColumn, comparison.rotation_deg.test);
      mark(kTranslationColumn, comparison.translation_m.test);
    }
  }
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
  const auto add = [&](std::size_t k, const char* statistic) {
    const std::size_t s = statistic_index(statistic);
    columns.add(statistic_column(kMeasures[k], statistic),
                [k, s](const SummaryRow& row) { return value_of(row.statistics, k, s); });
  };
  for (const std::size_t k : kDistances) {
    add(k, "median");
    add(k, "p95");
  }
  for (const std::size_t k : kPaperOrder) {
    add(k, "mean");
    add(k, "std");
  }
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
      SummaryRow all;
      static_cast<TrialSummary&>(all) = pooled(scenes_of(rows_of(summary, variant)));
      all.variant = variant;
      rows.push_back(all);
    }
  }
  table.table = export_columns().table(rows);
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
  const std::vector<std::string>& builds = table.caption.builds;
  sentences.insert(sentences.end(), builds.begin(), builds.end());
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

std::string export_csv(const ExportTable& table) { return csv_table(table.table); }

std::string export_json(const ExportTable& table) {
  const ExportCaption& caption = table.caption;
  return json_bytes({{"name", caption.name},
                     {"commit", caption.commit},
                     {"seed", caption.seed},
                     {"scenes", caption.scenes},
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

std::string export_markdown(const ExportTable& table) {
  View view{{{"variant"},
             {"sensor"},
             {"success %", "<success_percent> [<success_low_percent>, <success_high_percent>]"}},
            2};
  for (const std::size_t k : kDistances) {
    for (const char* statistic : {"median", "p95"}) {
      const Measure& measure = kMeasures[k];
      view.columns.push_back({std::string(measure.name) + " " + statistic + " " + measure.unit,
                              content_of(measure, std::string("<") + statistic + ">")});
    }
  }
  add_measures(view, kPaperOrder, "<mean> ± <std>");
  std::string text;
  for (const std::string& sentence : caption_sentences(table)) {
    text += markdown_escaped(sentence) + "\n";
  }
  return text + "Degrees of freedom: mean ± std.\n\n" + markdown_table(table.table, view);
}

const std::vector<ExportFormat>& export_formats() {
  static const std::vector<ExportFormat> formats = {
      {"csv", export_csv}, {"json", export_json}, {"latex", export_latex}, {"md", export_markdown}};
  return formats;
}

}  // namespace croon::experiments

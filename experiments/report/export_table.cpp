#include "experiments/report/export_table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "experiments/report/row_table.hpp"
#include "experiments/report/scene_summary.hpp"
#include "experiments/report/text.hpp"

namespace croon::experiments {

namespace {

ExportColumn error_column(std::size_t measure, const char* statistic, Better better) {
  const std::string unit = kMeasures[measure].unit;
  return {kMeasures[measure].name + std::string("_") + statistic + "_" + unit, unit == "m" ? 4 : 3,
          better};
}

std::vector<ExportColumn> make_columns() {
  std::vector<ExportColumn> columns = {{"success_percent", 1, Better::greater},
                                       {"success_low_percent", 1, Better::neither},
                                       {"success_high_percent", 1, Better::neither}};
  for (const std::size_t k : {kRotation, kTranslation}) {
    columns.push_back(error_column(k, "median", Better::less));
    columns.push_back(error_column(k, "p95", Better::less));
  }
  for (const std::size_t k : kPaperOrder) {
    columns.push_back(error_column(k, "mean", Better::nearer_to_zero));
    columns.push_back(error_column(k, "std", Better::less));
  }
  return columns;
}

/// All sensors of a variant as one row: outcomes and statistics.
SummaryRow all_sensors(const Summary& summary, const std::string& variant) {
  SummaryRow all;
  all.variant = variant;
  int agreeing = 0;
  std::vector<Measures> deviations;
  for (const SummaryRow& row : summary.rows) {
    if (row.variant != variant) continue;
    all.reference = std::min(all.reference, row.reference);
    add_outcomes(all.outcomes, row.outcomes);
    agreeing += row.agreement.count;
    for (const SceneSummary& scene : row.scenes) {
      deviations.insert(deviations.end(), scene.deviations.begin(), scene.deviations.end());
    }
  }
  all.success = share_of(all.outcomes.success, all.outcomes.trials);
  all.agreement = share_of(agreeing, all.outcomes.trials);
  all.counted = static_cast<int>(deviations.size());
  if (all.counted > 0) all.statistics = statistics_of(deviations);
  return all;
}

std::vector<ExportCell> cells_of(const SummaryRow& row) {
  std::vector<ExportCell> cells;
  const auto add = [&cells](std::optional<double> value) { cells.push_back({value, false, ""}); };
  const Share& share = main_share(row);
  for (const double ratio : {share.ratio, share.interval.low, share.interval.high}) {
    add(100.0 * ratio);
  }
  const auto add_statistic = [&](std::size_t k, double MeasureStatistics::*value, int least) {
    row.counted >= least ? add((*row.statistics)[k].*value) : add(std::nullopt);
  };
  for (const std::size_t k : {kRotation, kTranslation}) {
    add_statistic(k, &MeasureStatistics::median, 1);
    add_statistic(k, &MeasureStatistics::p95, 1);
  }
  for (const std::size_t k : kPaperOrder) {
    add_statistic(k, &MeasureStatistics::mean, 1);
    add_statistic(k, &MeasureStatistics::std, 2);
  }
  return cells;
}

ExportRow export_row(const SummaryRow& row) {
  return {row.variant,           row.sensor,  row.reference, row.outcomes.trials,
          main_share(row).count, row.counted, cells_of(row)};
}

/// Less is better. Of the digits that are shown: a reader who sees two equal numbers, one of them
/// bold, would look for a reason.
double rank(const ExportCell& cell, const ExportColumn& column) {
  if (!cell.value) return std::numeric_limits<double>::infinity();
  const std::string text = shown_text(cell, column);
  double shown = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), shown);
  if (column.better == Better::greater) return -shown;
  return column.better == Better::nearer_to_zero ? std::abs(shown) : shown;
}

/// Whether the row succeeds significantly less often than another of its sensor, whose rows are
/// [begin, end): its errors are of the easier trials then.
bool is_of_easier_trials(const std::vector<ExportRow>& rows, std::size_t begin, std::size_t end,
                         std::size_t row) {
  const auto sign = [&](std::size_t i) {
    const std::string& mark = rows[i].cells[kSuccessColumn].mark;
    return mark.empty() ? ' ' : mark[0];
  };
  if (sign(row) != ' ') return sign(row) == '-';
  // Neither better nor worse than the base: worse than what is better than the base.
  for (std::size_t i = begin; i < end; ++i) {
    if (sign(i) == '+') return true;
  }
  return false;
}

/// Marks the best of each column in the rows [begin, end), which are those of one sensor.
void mark_best(std::vector<ExportRow>& rows, std::size_t begin, std::size_t end) {
  for (std::size_t k = 0; k < export_columns().size(); ++k) {
    const ExportColumn& column = export_columns()[k];
    if (column.better == Better::neither) continue;
    const auto is_rival = [&](std::size_t i) {
      const ExportCell& cell = rows[i].cells[k];
      const bool is_worse_than_base = !cell.mark.empty() && cell.mark[0] == '-';
      if (!cell.value || is_worse_than_base) return false;
      return k == kSuccessColumn || !is_of_easier_trials(rows, begin, end, i);
    };
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = begin; i < end; ++i) {
      if (is_rival(i)) best = std::min(best, rank(rows[i].cells[k], column));
    }
    for (std::size_t i = begin; i < end; ++i) {
      ExportCell& cell = rows[i].cells[k];
      cell.is_best = is_rival(i) && rank(cell, column) == best;
    }
  }
}

/// Marks the best of each sensor's rows.
void mark_best(std::vector<ExportRow>& rows) {
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    while (end < rows.size() && rows[end].sensor == rows[begin].sensor) ++end;
    mark_best(rows, begin, end);
  }
}

std::string mark_of(const PairedTest& test) {
  if (!is_significant(test)) return "";
  return std::string(test.favours_variant ? "+" : "-") + (holds_by_scene(test) ? "**" : "*");
}

void set_marks(std::vector<ExportRow>& rows, const std::vector<Comparison>& comparisons) {
  for (const Comparison& comparison : comparisons) {
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const ExportRow& candidate) {
      return candidate.variant == comparison.variant && candidate.sensor == comparison.sensor;
    });
    if (row == rows.end()) continue;  // All sensors, of which there is one.
    const PairedTest tests[] = {comparison.success, comparison.rotation_deg.test,
                                comparison.translation_m.test};
    for (std::size_t i = 0; i < kMarkedColumns.size(); ++i) {
      const std::size_t k = kMarkedColumns[i];
      // Without truth the tests of errors are of how repeatable they are, which no column shows.
      if (k != kSuccessColumn && row->reference != Reference::truth) continue;
      row->cells[k].mark = mark_of(tests[i]);
    }
  }
}

}  // namespace

const std::vector<ExportColumn>& export_columns() {
  static const std::vector<ExportColumn> columns = make_columns();
  return columns;
}

std::string shown_text(const ExportCell& cell, const ExportColumn& column) {
  return cell.value ? fixed_number(*cell.value, column.decimals) : "-";
}

ExportTable export_table(const Summary& summary, const ExportCaption& caption) {
  ExportTable table{caption, summary.bounds, "", variants_of(summary), sensors_of(summary), {}};
  std::vector<SummaryRow> pooled;
  const auto add_sensor = [&](const std::vector<SummaryRow>& rows, const std::string& sensor) {
    for (const SummaryRow& row : rows) {
      if (row.sensor == sensor) table.rows.push_back(export_row(row));
    }
  };
  for (const std::string& sensor : table.sensors) add_sensor(summary.rows, sensor);
  if (table.sensors.size() > 1) {
    for (const std::string& variant : table.variants) {
      pooled.push_back(all_sensors(summary, variant));
    }
    add_sensor(pooled, "");
  }
  if (!summary.comparisons.empty()) table.base = summary.comparisons.front().base;
  set_marks(table.rows, summary.comparisons);
  if (table.variants.size() > 1) mark_best(table.rows);
  return table;
}

}  // namespace croon::experiments

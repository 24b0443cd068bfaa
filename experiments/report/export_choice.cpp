#include "experiments/report/export_choice.hpp"

#include <algorithm>

#include "experiments/report/figures.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

using Names = std::vector<std::string>;

/// All columns that can be chosen: counts, shares with their intervals, and for each measure mean ±
/// std, each statistic and, for distances, the interval of the paired difference.
std::vector<ExportColumn> all_columns(bool is_in_mm) {
  std::vector<ExportColumn> all;
  for (const char* count : {"scenes", "trials", "counted"}) {
    all.push_back({count, "", "", count, {count}});
  }
  for (const std::string share : {"success", "agreement"}) {
    all.push_back({share, share, "%", "rate", {share + "_percent"}});
    all.push_back({share + "_interval",
                   share,
                   "%",
                   kShareInterval,
                   {share + "_low_percent", share + "_high_percent"}});
  }
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    Measure measure = kMeasures[k];
    if (is_in_mm && measure.unit == std::string("m")) measure.unit = "mm";
    const auto add = [&](const std::string& name, const char* statistic, const Names& of) {
      all.push_back({measure.name + name, measure.name, measure.unit, statistic, {}});
      for (const std::string& column : of) {
        all.back().columns.push_back(statistic_column(measure, column).full_name());
      }
    };
    add("", kMeanAndStd, {"mean", "std"});
    for (const Statistic& statistic : kStatistics) {
      add(std::string("_") + statistic.name, statistic.name, {statistic.name});
    }
    if (k >= kDofs) add("_paired", kPairedInterval, {"paired_low", "paired_high"});
  }
  return all;
}

/// The columns called `names`. Throws InputError for unknown names.
std::vector<ExportColumn> columns_called(const Names& names, bool is_in_mm) {
  const std::vector<ExportColumn> all = all_columns(is_in_mm);
  Names known;
  for (const ExportColumn& column : all) known.push_back(column.name);
  refuse_unknown("--columns", names, known);
  std::vector<ExportColumn> columns;
  for (const std::string& name : names) {
    const auto index = std::find(known.begin(), known.end(), name) - known.begin();
    columns.push_back(all[static_cast<std::size_t>(index)]);
  }
  return columns;
}

/// The table with only these columns, in this order.
Table projected(const Table& table, const Names& names) {
  Table result;
  result.rows.resize(table.rows.size());
  for (const std::string& name : names) {
    const std::size_t k = table.index_of(name);
    result.columns.push_back(table.columns[k]);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      result.rows[i].push_back(table.rows[i][k]);
    }
  }
  return result;
}

/// Removes the rows of all other sensors.
void choose_rows(ExportTable& table, const TableChoice& choice) {
  Names sensors = choice.sensors;
  if (sensors.empty() && choice.is_compact && table.sensors.size() > 1) sensors = {kAllSensors};
  if (sensors.empty()) return;
  Names known = table.sensors;
  if (known.size() > 1) known.emplace_back(kAllSensors);
  refuse_unknown("--sensors", sensors, known);
  std::vector<CellRow> rows;
  for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
    const std::string sensor = name_of_sensor(table.table.text_at(i, "sensor"));
    if (std::find(sensors.begin(), sensors.end(), sensor) == sensors.end()) continue;
    rows.push_back(table.table.rows[i]);
  }
  table.table.rows = std::move(rows);
}

void convert_to_mm(Table& table) {
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    Column& column = table.columns[k];
    if (column.unit != "m") continue;
    column.unit = "mm";
    column.decimals -= 3;
    for (CellRow& row : table.rows) {
      if (auto* const value = std::get_if<double>(&row[k].value)) *value *= 1000.0;
    }
  }
}

/// Removes the marks of errors whose paired difference is not shown. Variants succeed in different
/// trials, so their medians can differ in the opposite direction.
void remove_unexplained_marks(ExportTable& table) {
  for (const std::size_t k : kDistances) {
    if (shows(table, kPairedInterval, kMeasures[k].name)) continue;
    for (const ExportColumn& column : table.chosen) {
      if (column.subject != kMeasures[k].name || column.statistic != "median") continue;
      const std::size_t median = table.table.index_of(column.columns.front());
      table.table.columns[median].has_marks = false;
      for (CellRow& row : table.table.rows) row[median].mark.clear();
    }
  }
}

/// The shares needed to show the success of `summaries`: success, agreement for rows without ground
/// truth (which have no success), or both.
Names shares_of(const std::vector<Summary>& summaries) {
  bool has_success = false;
  bool lacks_success = false;
  bool has_agreement = false;
  for (const Summary& summary : summaries) {
    for (const SummaryRow& row : summary.rows) {
      (lacks_truth(row) ? lacks_success : has_success) = true;
      has_agreement = has_agreement || agreement_of(row) != nullptr;
    }
  }
  Names shares;
  if (has_success) shares.emplace_back("success");
  if (lacks_success && has_agreement) shares.emplace_back("agreement");
  return shares;
}

/// The names of the experiments in a joined table; "NAME in FOLDER" for a duplicate name.
Names names_of(const std::vector<ExportTable>& tables, const Names& folders) {
  Names names;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string& name = tables[i].caption.name;
    const auto has_name = [&](const ExportTable& table) { return table.caption.name == name; };
    const bool is_alone = std::count_if(tables.begin(), tables.end(), has_name) == 1;
    names.push_back(is_alone ? name : name + " in " + folders[i]);
  }
  return names;
}

}  // namespace

std::vector<std::string> page_columns(const std::vector<Summary>& summaries, bool is_one_column) {
  Names columns;
  for (const std::string& share : shares_of(summaries)) {
    columns.push_back(share);
    if (!is_one_column) columns.push_back(share + "_interval");
  }
  for (const std::size_t k : kDistances) {
    columns.push_back(std::string(kMeasures[k].name) + "_median");
    if (!is_one_column) columns.push_back(std::string(kMeasures[k].name) + "_p95");
  }
  return columns;
}

std::vector<ExportColumn> shown_columns(const ExportTable& table) {
  if (!table.chosen.empty()) return table.chosen;
  Names names;
  for (const std::string& share : share_names(table.table)) {
    names.insert(names.end(), {share, share + "_interval"});
  }
  for (const std::size_t k : kDistances) {
    const std::string name = kMeasures[k].name;
    names.insert(names.end(), {name + "_median", name + "_p95"});
    if (!table.base.empty()) names.push_back(name + "_paired");
  }
  for (const std::size_t k : kPaperOrder) names.emplace_back(kMeasures[k].name);
  return columns_called(names, table.is_in_mm);
}

bool shows(const ExportTable& table, const std::string& statistic, const std::string& subject) {
  for (const ExportColumn& column : shown_columns(table)) {
    if (column.statistic == statistic && (subject.empty() || column.subject == subject))
      return true;
  }
  return false;
}

void choose(ExportTable& table, const TableChoice& choice) {
  choose_rows(table, choice);
  if (choice.is_in_mm) convert_to_mm(table.table);
  table.is_in_mm = choice.is_in_mm;
  table.is_one_column = choice.is_one_column;
  if (choice.columns.empty()) return;
  table.chosen = columns_called(choice.columns, choice.is_in_mm);
  // Files always include the columns that identify a row, even if readers do not see them.
  Names names = {"variant", "sensor", "reference", "scenes", "trials"};
  for (const ExportColumn& column : table.chosen) {
    for (const std::string& name : column.columns) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  table.table = projected(table.table, names);
  remove_unexplained_marks(table);
}

ExportTable joined(std::vector<ExportTable> tables, const std::vector<std::string>& folders) {
  if (tables.size() == 1) return tables.front();
  ExportTable whole = tables.front();
  whole.table.rows.clear();
  whole.table.columns.insert(whole.table.columns.begin(), Column{"experiment"});
  const Names names = names_of(tables, folders);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    ExportTable& table = tables[i];
    if (table.bounds.rotation_deg != whole.bounds.rotation_deg ||
        table.bounds.translation_m != whole.bounds.translation_m) {
      throw InputError(folders[i], "",
                       "expected success within " + bounds_text(whole.bounds) +
                           "ground truth, as in " + folders.front() + ", found " +
                           bounds_text(table.bounds) + "ground truth");
    }
    for (CellRow& row : table.table.rows) {
      row.insert(row.begin(), to_cell(names[i]));
      whole.table.rows.push_back(row);
    }
    for (const auto& [all, own] :
         {std::pair(&whole.variants, &table.variants), std::pair(&whole.sensors, &table.sensors)}) {
      for (const std::string& name : *own) {
        if (std::find(all->begin(), all->end(), name) == all->end()) all->push_back(name);
      }
    }
    for (std::size_t k = 1; k < whole.table.columns.size(); ++k) {
      whole.table.columns[k].has_marks |= table.table.columns[k - 1].has_marks;
    }
    table.table.columns.insert(table.table.columns.begin(), Column{"experiment"});
    whole.parts.push_back(table);
  }
  return whole;
}

}  // namespace croon::experiments

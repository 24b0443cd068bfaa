#include "experiments/report/export_choice.hpp"

#include <algorithm>
#include <cmath>

#include "experiments/report/figures.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

using Names = std::vector<std::string>;

constexpr std::string_view kPercent = "_percent";

bool ends_with(const std::string& text, std::string_view end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

bool has_column(const Table& table, const std::string& name) {
  return std::any_of(table.columns.begin(), table.columns.end(),
                     [&](const Column& column) { return column.full_name() == name; });
}

/// "translation_median_m".
std::string column_name(const Measure& measure, const char* statistic) {
  return statistic_column(measure, statistic).full_name();
}

/// All columns that can be chosen from a table with all statistics: counts, shares with their
/// intervals, each measure as mean ± std, and each statistic of each measure.
std::vector<ChosenColumn> column_choices(const Table& table) {
  std::vector<ChosenColumn> choices = {{"scenes", "", "scenes", {"scenes"}, Joint::none},
                                       {"trials", "", "trials", {"trials"}, Joint::none},
                                       {"counted", "", "counted", {"counted"}, Joint::none}};
  for (const Column& column : table.columns) {
    const std::string name = column.full_name();
    if (column.better != Better::greater || !ends_with(name, kPercent)) continue;
    const std::string share = name.substr(0, name.size() - kPercent.size());
    choices.push_back({share, share + " (%)", "rate", {name}, Joint::none});
    choices.push_back({share + "_interval",
                       share + " (%)",
                       "95 % interval",
                       {share + "_low_percent", share + "_high_percent"},
                       Joint::interval});
  }
  for (const std::size_t k : kDistances) {
    const std::string name = std::string(kMeasures[k].name) + "_paired";
    const std::string unit = kMeasures[k].unit;
    choices.push_back({name,
                       std::string(kMeasures[k].name) + " (" + unit + ")",
                       "paired",
                       {name + "_low_" + unit, name + "_high_" + unit},
                       Joint::interval});
  }
  for (const Measure& measure : kMeasures) {
    const std::string group = std::string(measure.name) + " (" + measure.unit + ")";
    choices.push_back({measure.name,
                       group,
                       "mean ± std",
                       {column_name(measure, "mean"), column_name(measure, "std")},
                       Joint::spread});
    for (const Statistic& statistic : kStatistics) {
      choices.push_back({std::string(measure.name) + "_" + statistic.name,
                         group,
                         statistic.name,
                         {column_name(measure, statistic.name)},
                         Joint::none});
    }
  }
  return choices;
}

std::vector<ChosenColumn> chosen_columns(const Table& table, const Names& names) {
  const std::vector<ChosenColumn> choices = column_choices(table);
  Names known;
  for (const ChosenColumn& choice : choices) known.push_back(choice.name);
  refuse_unknown("--columns", names, known);
  std::vector<ChosenColumn> chosen;
  for (const std::string& name : names) {
    const auto index = std::find(known.begin(), known.end(), name) - known.begin();
    chosen.push_back(choices[static_cast<std::size_t>(index)]);
  }
  return chosen;
}

/// The table with only these columns, in this order.
Table projected(const Table& table, const Names& names) {
  Table result;
  result.rows.resize(table.rows.size());
  for (const std::string& name : names) {
    if (has_column(result, name)) continue;
    const std::size_t k = table.index_of(name);
    result.columns.push_back(table.columns[k]);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      result.rows[i].push_back(table.rows[i][k]);
    }
  }
  return result;
}

/// Removes the rows of all other sensors.
void choose_rows(ExportTable& table, const Names& sensors) {
  if (sensors.empty()) return;
  Names known = table.sensors;
  if (known.size() > 1) known.emplace_back(kAllSensors);
  refuse_unknown("--sensors", sensors, known);
  const auto is_chosen = [&](const std::string& sensor) {
    return std::find(sensors.begin(), sensors.end(), name_of_sensor(sensor)) != sensors.end();
  };
  std::vector<CellRow> rows;
  for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
    if (is_chosen(table.table.text_at(i, "sensor"))) rows.push_back(table.table.rows[i]);
  }
  table.table.rows = std::move(rows);
}

std::string in_mm(const std::string& name) { return ends_with(name, "_m") ? name + "m" : name; }

void change_to_mm(ExportTable& table) {
  constexpr int kDigits = 3;
  for (std::size_t k = 0; k < table.table.columns.size(); ++k) {
    Column& column = table.table.columns[k];
    if (column.unit != "m") continue;
    column.unit = "mm";
    column.decimals = std::max(0, column.decimals - kDigits);
    for (CellRow& row : table.table.rows) {
      if (auto* const value = std::get_if<double>(&row[k].value)) *value *= 1000.0;
    }
  }
  for (ChosenColumn& chosen : table.chosen) {
    for (std::string& name : chosen.columns) name = in_mm(name);
  }
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size())) {
    text.replace(at, old.size(), by);
  }
  return text;
}

/// The content of a cell in a chosen column.
std::string content_of(const ChosenColumn& chosen, bool is_latex) {
  const std::string first = "<" + chosen.columns.front() + ">";
  if (chosen.joint == Joint::none) return first;
  const std::string second = "<" + chosen.columns.back() + ">";
  if (chosen.joint == Joint::interval) {
    return is_latex ? first + "\\,to\\," + second : "[" + first + ", " + second + "]";
  }
  return first + (is_latex ? "\\,${}\\pm{}$\\," : " ± ") + second;
}

/// Removes the marks of errors whose paired difference is not shown. Variants succeed in different
/// trials, so their medians can differ in the opposite direction.
void remove_unexplained_marks(ExportTable& table) {
  for (const std::size_t k : kDistances) {
    const std::string name = kMeasures[k].name;
    const bool is_explained =
        std::any_of(table.chosen.begin(), table.chosen.end(),
                    [&](const ChosenColumn& chosen) { return chosen.name == name + "_paired"; });
    const std::string median = column_name(kMeasures[k], "median");
    if (is_explained || !has_column(table.table, median)) continue;
    const std::size_t column = table.table.index_of(median);
    table.table.columns[column].has_marks = false;
    for (CellRow& row : table.table.rows) row[column].mark.clear();
  }
}

/// Whether the rows of the table differ in `column`.
bool has_several(const Table& table, const char* column) {
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const CellRow& row) {
    const std::size_t k = table.index_of(column);
    return row[k].value != table.rows.front()[k].value;
  });
}

}  // namespace

namespace {

/// Whether any, and whether all, rows of a table have a value in a column.
struct Filled {
  bool any = false;
  bool all = true;
};

Filled filled(const Table& table, const std::string& column) {
  Filled filled;
  for (const CellRow& row : table.rows) {
    const bool has_value = !row[table.index_of(column)].is_nothing();
    filled.any = filled.any || has_value;
    filled.all = filled.all && has_value;
  }
  return filled;
}

/// The shares needed to show the success of `summaries`: success, agreement for rows without ground
/// truth (which have no success), or both.
Names shares_of(const std::vector<Summary>& summaries) {
  std::vector<Table> tables;
  for (const Summary& summary : summaries) tables.push_back(export_table(summary, {}).table);
  Names shares;
  for (const ChosenColumn& column : column_choices(tables.front())) {
    if (!ends_with(column.columns.front(), kPercent) || column.joint != Joint::none) continue;
    Filled of_all;
    for (const Table& table : tables) {
      const Filled own = filled(table, column.columns.front());
      of_all.any = of_all.any || own.any;
      of_all.all = of_all.all && own.all;
    }
    if (of_all.any) shares.push_back(column.name);
    if (of_all.all) break;
  }
  return shares;
}

}  // namespace

std::vector<TableChoice> compact(const TableChoice& choice, const std::vector<Summary>& summaries) {
  Names columns = choice.columns;
  if (columns.empty()) {
    for (const std::string& share : shares_of(summaries)) {
      columns.push_back(share);
      if (!choice.is_one_column) columns.push_back(share + "_interval");
    }
    for (const char* measure : {"rotation", "translation"}) {
      columns.push_back(std::string(measure) + "_median");
      if (!choice.is_one_column) columns.push_back(std::string(measure) + "_p95");
    }
  }
  std::vector<TableChoice> choices;
  for (const Summary& summary : summaries) {
    TableChoice& own = choices.emplace_back(choice);
    own.columns = columns;
    if (own.sensors.empty() && sensors_of(summary).size() > 1) own.sensors = {kAllSensors};
  }
  return choices;
}

void add_all_statistics(Columns<SummaryRow>& columns) {
  const Table present{columns.columns(), {}};
  for (std::size_t k = 0; k < kMeasures.size(); ++k) {
    for (std::size_t s = 0; s < kStatistics.size(); ++s) {
      const Column column = statistic_column(kMeasures[k], kStatistics[s].name);
      if (has_column(present, column.full_name())) continue;
      columns.add(column, [k, s](const SummaryRow& row) { return value_of(row.statistics, k, s); });
    }
  }
}

void choose(ExportTable& table, const TableChoice& choice) {
  choose_rows(table, choice.sensors);
  table.is_one_column = choice.is_one_column;
  if (!choice.columns.empty()) {
    table.chosen = chosen_columns(table.table, choice.columns);
    // Files always include the columns that identify a row, even if readers do not see them.
    Names names = {"variant", "sensor", "reference", "scenes", "trials"};
    for (const ChosenColumn& chosen : table.chosen) {
      names.insert(names.end(), chosen.columns.begin(), chosen.columns.end());
    }
    table.table = projected(table.table, names);
    remove_unexplained_marks(table);
  }
  if (choice.is_in_mm) change_to_mm(table);
  table.is_in_mm = choice.is_in_mm;
}

namespace {

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

View chosen_view(const ExportTable& table, bool is_latex) {
  View view;
  const bool of_sensors =
      !has_several(table.table, "variant") && has_several(table.table, "sensor");
  if (is_latex) {
    view.columns.push_back({of_sensors ? "sensor" : "variant"});
    const bool has_headings =
        !table.parts.empty() || (!of_sensors && has_several(table.table, "sensor"));
    if (has_headings) view.heading = "heading";
  } else {
    if (!table.parts.empty()) view.columns.push_back({"experiment"});
    view.columns.push_back({"variant"});
    view.columns.push_back({"sensor"});
    view.names = view.columns.size();
  }
  for (const ChosenColumn& chosen : table.chosen) {
    const std::string content = content_of(chosen, is_latex);
    if (is_latex) {
      view.columns.push_back(
          {replaced(replaced(chosen.title, "±", "$\\pm$"), "95 %", "95\\,\\%"), content, false,
           replaced(replaced(chosen.group, "(deg)", "($^\\circ$)"), "%", "\\%")});
    } else {
      view.columns.push_back(
          {chosen.group + (chosen.group.empty() ? "" : " ") + chosen.title, content});
    }
  }
  if (table.is_in_mm) {
    for (Shown& shown : view.columns) {
      shown.group = replaced(shown.group, "(m)", "(mm)");
      if (!is_latex) shown.title = replaced(shown.title, "(m)", "(mm)");
    }
  }
  return view;
}

View in_unit_of(const ExportTable& table, View view) {
  if (!table.is_in_mm) return view;
  for (Shown& shown : view.columns) {
    shown.content = replaced(shown.content, "_m>", "_mm>");
    shown.group = replaced(shown.group, "(m)", "(mm)");
    if (ends_with(shown.title, " m")) shown.title += "m";
  }
  return view;
}

Table with_heading(const ExportTable& table) {
  Table result = table.table;
  result.columns.insert(result.columns.begin(), Column{"heading"});
  const bool has_sensors = has_several(table.table, "sensor");
  const bool of_sensors = has_sensors && !has_several(table.table, "variant");
  const std::size_t sensor = table.table.index_of("sensor");
  for (std::size_t i = 0; i < table.table.rows.size(); ++i) {
    const CellRow& row = table.table.rows[i];
    std::string heading;
    if (!table.parts.empty()) heading = table.table.text_at(i, "experiment");
    if (has_sensors && !of_sensors) {
      heading +=
          (heading.empty() ? "" : ", ") + shown_text(row[sensor], table.table.columns[sensor]);
    }
    result.rows[i].insert(result.rows[i].begin(), to_cell(heading));
  }
  return result;
}

void refuse_too_wide(const ExportTable& table, const View& view) {
  // \scriptsize of a document of 10 pt is 7 pt; a digit of Computer Modern is 4 pt wide.
  constexpr double kDigit_mm = 4.0 / kPointsPerMm;
  constexpr double kLetter_mm = 3.5 / kPointsPerMm;
  constexpr double kSeparation_mm = 5.0 / kPointsPerMm;
  constexpr double kJoint_mm = 8.0 / kPointsPerMm;  // "±" or "--" with the space around it.
  const double page = table.is_one_column ? kOneColumn_mm : kTwoColumns_mm;
  const auto max_width_mm = [&](std::size_t k, bool of_marks) {
    std::size_t columns = 0;
    for (const CellRow& row : table.table.rows) {
      const std::string text = of_marks ? row[k].mark : shown_text(row[k], table.table.columns[k]);
      columns = std::max(columns, text_columns(text));
    }
    return kDigit_mm * static_cast<double>(columns);
  };
  const std::size_t name = table.table.index_of(view.columns.front().title);
  double width = std::min(max_width_mm(name, false), kNameShare * page);
  double of_group = 0.0;  // Neighbouring columns with a common title.
  for (std::size_t i = 0; i < table.chosen.size(); ++i) {
    const ChosenColumn& chosen = table.chosen[i];
    double cells = chosen.joint == Joint::none ? 0.0 : kJoint_mm;
    for (const std::string& column : chosen.columns) {
      const std::size_t k = table.table.index_of(column);
      const double marks = max_width_mm(k, true);
      cells += max_width_mm(k, false) + marks + (marks > 0.0 ? kSeparation_mm : 0.0);
    }
    const double title = kLetter_mm * static_cast<double>(text_columns(chosen.title));
    of_group += kSeparation_mm + std::max(cells, title);
    if (i + 1 < table.chosen.size() && table.chosen[i + 1].group == chosen.group) continue;
    const double group = kLetter_mm * static_cast<double>(text_columns(chosen.group));
    width += std::max(of_group, kSeparation_mm + group);
    of_group = 0.0;
  }
  constexpr double kUsablePage = 0.97;  // The estimate may be too low.
  if (width <= kUsablePage * page) return;
  throw InputError("", "--columns",
                   "these " + std::to_string(table.chosen.size()) + " columns need about " +
                       fixed_number(std::ceil(width), 0) + " mm; the page is " +
                       fixed_number(kUsablePage * page, 0) + " mm wide; choose fewer" +
                       (table.is_one_column ? " or --width two_columns" : ""));
}

}  // namespace croon::experiments

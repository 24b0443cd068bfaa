#pragma once

#include <string>
#include <vector>

#include "experiments/report/export.hpp"

namespace croon::experiments {

// The shown part of an exported table: columns, sensors, units, and several experiments in one.

/// The choices for a table.
struct TableChoice {
  std::vector<std::string> sensors;  ///< Rows; "all" is the row of all sensors. Empty: every row.
  std::vector<std::string> columns;  ///< Names of `column_choices`; empty: the full table.
  bool is_in_mm = false;             ///< Whether lengths are in millimetres.
  bool is_one_column = false;        ///< For one column of a two-column page (LaTeX).
};

/// The choices for one compact table of several experiments (at least one): the same columns for
/// all, limited to what fits on a page, and one row per variant, over all sensors if there are
/// several. Settings already made in `choice` are kept.
std::vector<TableChoice> compact(const TableChoice& choice, const std::vector<Summary>& summaries);

/// Adds the columns of every statistic that `columns` lacks.
void add_all_statistics(Columns<SummaryRow>& columns);

/// Reduces `table`, which has all statistics, to what is chosen. Throws InputError for names that
/// the table lacks.
void choose(ExportTable& table, const TableChoice& choice);

/// The tables of several experiments as one, rows grouped by experiment. Throws InputError if their
/// success bounds differ; `folders` are for its message.
ExportTable joined(std::vector<ExportTable> tables, const std::vector<std::string>& folders);

/// The view of the chosen columns, for LaTeX or Markdown.
View chosen_view(const ExportTable& table, bool is_latex);

/// Converts the columns of a view with lengths in metres to the unit of `table`.
View in_unit_of(const ExportTable& table, View view);

/// The table with a first column "heading": experiment and sensor, where there are several.
Table with_heading(const ExportTable& table);

/// Throws InputError if the LaTeX table of the chosen columns is wider than its page.
void refuse_too_wide(const ExportTable& table, const View& view);

}  // namespace croon::experiments

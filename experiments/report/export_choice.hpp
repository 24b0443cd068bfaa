#pragma once

#include <string>
#include <vector>

#include "experiments/report/export.hpp"

namespace croon::experiments {

// What of an exported table is shown: columns, sensors, units, and several experiments in one.

/// What a table is made of.
struct TableChoice {
  std::vector<std::string> sensors;  ///< Rows; "all" is all sensors together. Empty: every row.
  std::vector<std::string> columns;  ///< Names of `column_choices`; empty: the full table.
  bool is_in_mm = false;             ///< Lengths.
  bool is_one_column = false;        ///< For one column of a page with two (LaTeX).
};

/// The choices of the compact tables of several experiments, at least one, for one table: the same
/// columns, as many as a page has room for, and a row per variant, all sensors together if there
/// are several. What `choice` has already is kept.
std::vector<TableChoice> compact(const TableChoice& choice, const std::vector<Summary>& summaries);

/// Adds the columns of every statistic that `columns` lacks.
void add_all_statistics(Columns<SummaryRow>& columns);

/// Leaves in `table`, which has all statistics, what is chosen. Throws InputError for names that
/// the table lacks.
void choose(ExportTable& table, const TableChoice& choice);

/// The tables of several experiments as one, rows grouped by experiment. Throws InputError if two
/// have one name or their trials are judged by other bounds; `folders` are for its message.
ExportTable joined(std::vector<ExportTable> tables, const std::vector<std::string>& folders);

/// The view of the chosen columns, for LaTeX or for Markdown.
View chosen_view(const ExportTable& table, bool is_latex);

/// The columns of a view of lengths in metres, in the unit of `table`.
View in_unit_of(const ExportTable& table, View view);

/// The table with a column "heading" in front: experiment and sensor, as far as there are several.
Table with_heading(const ExportTable& table);

/// Throws InputError if the LaTeX table of the chosen columns is wider than its page.
void refuse_too_wide(const ExportTable& table, const View& view);

}  // namespace croon::experiments

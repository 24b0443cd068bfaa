#pragma once

#include <string>
#include <vector>

#include "experiments/report/export.hpp"

namespace croon::experiments {

// The shown part of an exported table: columns, sensors, units, and several experiments in one.

/// The choices for a table.
struct TableChoice {
  std::vector<std::string> sensors;  ///< Rows; "all" is the row of all sensors. Empty: every row.
  std::vector<std::string> columns;  ///< Names of columns; empty: the full table.
  bool is_in_mm = false;             ///< Whether lengths are in millimetres.
  bool is_one_column = false;        ///< For one column of a two-column page (LaTeX).
  bool is_compact = false;           ///< One row per variant, unless sensors are chosen.
};

/// The names of the columns that show the results of several experiments within the width of a page
/// or of one of its two columns.
std::vector<std::string> page_columns(const std::vector<Summary>& summaries, bool is_one_column);

/// Reduces `table`, which has all statistics, to what is chosen. Throws InputError for names that
/// the table lacks.
void choose(ExportTable& table, const TableChoice& choice);

/// The tables of several experiments as one, rows grouped by experiment. Throws InputError if their
/// success bounds differ; `folders` are for its message.
ExportTable joined(std::vector<ExportTable> tables, const std::vector<std::string>& folders);

/// The columns for readers: the chosen ones, or those of the full table.
std::vector<ExportColumn> shown_columns(const ExportTable& table);

/// Whether readers see this statistic; if `subject` is not empty, that of this subject.
bool shows(const ExportTable& table, const std::string& statistic, const std::string& subject = "");

}  // namespace croon::experiments

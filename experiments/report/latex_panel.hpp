#pragma once

#include <string>
#include <vector>

#include "experiments/report/export_table.hpp"

namespace croon::experiments {

/// Numbers under one head, as "0.010 ± 0.003".
struct Head {
  std::string title;
  std::vector<std::size_t> columns;
  std::string between;
};

struct Group {
  std::string title;
  std::vector<Head> heads;
};

/// Columns of an exported table that stand beside each other. A page is too narrow for all, so
/// there are two panels, one above the other.
using Panel = std::vector<Group>;

/// Success, its interval, and the two distances.
Panel success_panel();

/// Mean and standard deviation of the degrees of freedom.
Panel dof_panel();

/// Rows of a table from `begin` to before `end`.
struct RowRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The lines that the row takes, with the heading of its sensor where one stands above it.
std::size_t lines_of(const ExportTable& table, std::size_t row);

/// A tabular with the rows.
std::string latex_panel(const ExportTable& table, const Panel& panel, const RowRange& rows);

}  // namespace croon::experiments

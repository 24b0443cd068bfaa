#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/table/table.hpp"

namespace croon {

// The formats of a table, each in its own file: text_table.cpp, csv_table.cpp, json_table.cpp,
// markdown_table.cpp and latex_table.cpp.

/// Rows in aligned columns with an underlined header, for terminals; `bold_header` adds escape
/// codes.
std::string text_table(const Table& table, const View& view, bool bold_header = false);

/// `text` in one line, for cells: line breaks become spaces, the rest is made `printable`.
std::string one_line(std::string text);

/// A CSV file: a header and a line per row, as in RFC 4180, but lines end in "\n". A cell without a
/// value is an empty field, or "all" in a column where it means all. Additional "_mark" columns at
/// the end contain the marks.
std::string csv_table(const Table& table);
std::string csv_header(const std::vector<Column>& columns);
std::string csv_line(const std::vector<Column>& columns, const CellRow& row);

/// The CSV file of `rows`, without a table of all cells in memory.
template <class Row>
std::string csv_of(const Columns<Row>& columns, const std::vector<Row>& rows) {
  std::string bytes = csv_header(columns.columns());
  for (const Row& row : rows) bytes += csv_line(columns.columns(), columns.cells(row));
  return bytes;
}

/// The rows as a list of objects, each value at the path of its column; null without a value, and
/// for an object or list that would contain only nulls. Infinite numbers, which JSON lacks, are the
/// strings "inf" and "-inf". If a column has marks, the names of the best and the marked columns
/// are included.
nlohmann::ordered_json json_rows(const Table& table);

/// `json` as the bytes of a file; bytes that are not UTF-8 are replaced.
std::string json_bytes(const nlohmann::ordered_json& json);

/// A table in GitHub's Markdown, with the best values bold.
std::string markdown_table(const Table& table, const View& view);

/// `text` escaped for a Markdown cell or sentence.
std::string markdown_escaped(const std::string& text);

/// The maximum share of the page width for names in LaTeX.
inline constexpr double kLatexNameShare = 0.3;

/// A LaTeX table as one tabular per page, with booktabs rules and siunitx columns (version 2 or 3),
/// the best values bold, marks in separate columns. The first column of the view has names, the
/// others numbers; long names are broken into lines of `kLatexNameShare` of the text width.
std::vector<std::string> latex_pages(const Table& table, const View& view);

/// A LaTeX tabular with booktabs rules of any table, whose cells are text.
std::string latex_tabular(const Table& table, const View& view);

}  // namespace croon

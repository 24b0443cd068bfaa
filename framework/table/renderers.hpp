#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/table/table.hpp"

namespace croon {

// The formats of a table, each in a file of its own: text_table.cpp, csv_table.cpp, json_table.cpp,
// markdown_table.cpp and latex_table.cpp.

/// Rows in aligned columns, as terminals show them, the header underlined; `bold_header` for a
/// terminal.
std::string text_table(const Table& table, const View& view, bool bold_header = false);

/// `text` in one line, as cells for readers have it: a space for each line break, else `printable`.
std::string one_line(std::string text);

/// A CSV file: a header and a line per row, as in RFC 4180, but lines end in "\n". Nothing is an
/// empty field, or "all" in a column in which it stands for all. After the columns, there is one
/// "_mark" column for each of those with marks.
std::string csv_table(const Table& table);
std::string csv_header(const std::vector<Column>& columns);
std::string csv_line(const std::vector<Column>& columns, const CellRow& row);

/// The bytes of a CSV file of `rows`, without a table of all cells in memory.
template <class Row>
std::string csv_of(const Columns<Row>& columns, const std::vector<Row>& rows) {
  std::string bytes = csv_header(columns.columns());
  for (const Row& row : rows) bytes += csv_line(columns.columns(), columns.cells(row));
  return bytes;
}

/// The rows as a list of objects, each value at the path of its column; null for nothing, and for
/// an object or a list that would hold nulls alone. JSON has no infinite numbers: they are the
/// texts "inf" and "-inf". If a column has marks, the names of the best and the marked columns too.
nlohmann::ordered_json json_rows(const Table& table);

/// `json` as the bytes of a file; bytes that are not UTF-8 are replaced.
std::string json_bytes(const nlohmann::ordered_json& json);

/// A table as GitHub reads it, the best values bold.
std::string markdown_table(const Table& table, const View& view);

/// `text` as Markdown shows it in a cell or a sentence.
std::string markdown_escaped(const std::string& text);

/// A LaTeX table as one or more pages, each with the rows that it holds in one tabular per view,
/// one above the other. Tabulars have booktabs rules and siunitx columns (version 2 or 3), the best
/// values bold, marks in columns of their own. The first column of a view is names, the others have
/// numbers; long names are broken into lines of `name_share` of the width of the text.
std::vector<std::string> latex_pages(const Table& table, const std::vector<View>& panels,
                                     double name_share = 0.16);

}  // namespace croon

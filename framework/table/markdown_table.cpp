#include <string_view>

#include "framework/table/renderers.hpp"

namespace croon {

namespace {

std::string markdown_cell(const Cell& cell, const Column& column) {
  const std::string text = markdown_escaped(shown_text(cell, column));
  return (cell.is_best ? "**" + text + "**" : text) +
         (cell.mark.empty() ? "" : " " + markdown_escaped(cell.mark));
}

}  // namespace

std::string markdown_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : one_line(text)) {
    if (std::string_view("\\`*_[]<>|~&#").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c;
  }
  return escaped;
}

std::string markdown_table(const Table& table, const View& wanted) {
  const View view = with_heading_as_column(wanted);
  std::string text = "|";
  std::string rule = "|";
  for (std::size_t k = 0; k < view.columns.size(); ++k) {
    text += " " + markdown_escaped(view.columns[k].title) + " |";
    rule += k < view.names ? "---|" : "---:|";
  }
  text += "\n" + rule + "\n";
  const std::vector<ShownCells> columns = shown_cells(table, view);
  for (const CellRow& row : table.rows) {
    text += "|";
    for (const ShownCells& column : columns)
      text += " " + column.content(row, markdown_cell) + " |";
    text += "\n";
  }
  return text;
}

}  // namespace croon

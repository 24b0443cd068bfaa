#include <algorithm>

#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon {

namespace {

constexpr const char* kGap = "  ";

std::string text_cell(const Cell& cell, const Column& column) {
  return one_line(shown_text(cell, column) + cell.mark);
}

bool has_long_heading(const Table& table, const View& view) {
  constexpr std::size_t kLong = 16;
  for (std::size_t i = 0; !view.heading.empty() && i < table.rows.size(); ++i) {
    if (text_columns(table.text_at(i, view.heading)) > kLong) return true;
  }
  return false;
}

}  // namespace

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return printable(text);
}

std::string text_table(const Table& table, const View& wanted, bool bold_header) {
  const View view = has_long_heading(table, wanted) ? wanted : with_heading_as_column(wanted);
  // The titles, the rule and one line per row, built column by column.
  std::vector<std::string> lines(2 + table.rows.size());
  const std::vector<ShownCells> columns = shown_cells(table, view);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const bool is_name = k < view.names;
    std::vector<std::string> cells = {view.columns[k].title, ""};
    for (const CellRow& row : table.rows) {
      const std::string text = columns[k].content(row, text_cell);
      cells.push_back(is_name ? cut_in_the_middle(text, view.max_name_columns) : text);
    }
    std::size_t width = 0;
    for (const std::string& cell : cells) width = std::max(width, text_columns(cell));
    cells[1] = std::string(width, '-');
    for (std::size_t i = 0; i < lines.size(); ++i) {
      lines[i] += k > 0 ? kGap : "";
      lines[i] += is_name ? left_aligned(cells[i], width) : right_aligned(cells[i], width);
    }
  }
  for (std::string& line : lines) line.erase(line.find_last_not_of(' ') + 1);
  std::string text = bold_header ? "\033[1m" + lines[0] + "\033[0m" : lines[0];
  text += "\n" + lines[1] + "\n";
  std::string heading;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (!view.heading.empty() && (i == 0 || table.text_at(i, view.heading) != heading)) {
      heading = table.text_at(i, view.heading);
      if (!heading.empty()) text += one_line(heading) + "\n";
    }
    text += lines[i + 2] + "\n";
  }
  return text;
}

}  // namespace croon

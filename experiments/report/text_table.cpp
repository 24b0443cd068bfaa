#include <algorithm>

#include "experiments/report/export.hpp"
#include "experiments/report/renderers.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {

namespace {

constexpr const char* kGap = "  ";

/// A row as text, below its heading if that changes here.
struct Line {
  std::string heading;
  std::vector<std::string> cells;
};

std::string cell_text(const Cell& cell, const Column& column) {
  std::string text = shown_text(cell, column) + cell.mark;
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::vector<Line> lines_of(const Table& table, const View& view) {
  const std::vector<ShownCells> columns = shown_cells(table, view);
  std::vector<Line> lines;
  std::string last_heading;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    Line line;
    if (!view.heading.empty() && (i == 0 || table.text_at(i, view.heading) != last_heading)) {
      line.heading = last_heading = table.text_at(i, view.heading);
    }
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string text = columns[k].content(table.rows[i], cell_text);
      line.cells.push_back(k < view.names ? cut_to_columns(text, view.widest_name) : text);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// The cells side by side, without spaces at the end.
std::string joined(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                   std::size_t names) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k > 0) line += kGap;
    line += k < names ? left_aligned(cells[k], widths[k]) : right_aligned(cells[k], widths[k]);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

}  // namespace

std::string text_table(const Table& table, const View& view, bool bold_header) {
  const std::vector<std::string> titles = titles_of(view);
  const std::vector<Line> lines = lines_of(table, view);
  std::vector<std::size_t> widths;
  std::vector<std::string> rules;
  for (std::size_t k = 0; k < titles.size(); ++k) {
    widths.push_back(text_columns(titles[k]));
    for (const Line& line : lines) {
      widths[k] = std::max(widths[k], text_columns(line.cells[k]));
    }
    rules.emplace_back(widths[k], '-');
  }
  const std::string header = joined(titles, widths, view.names);
  std::string text = bold_header ? "\033[1m" + header + "\033[0m" : header;
  text += "\n" + joined(rules, widths, view.names) + "\n";
  for (const Line& line : lines) {
    if (!line.heading.empty()) text += line.heading + "\n";
    text += joined(line.cells, widths, view.names) + "\n";
  }
  return text;
}

}  // namespace croon::experiments

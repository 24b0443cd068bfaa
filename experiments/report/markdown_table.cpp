#include <algorithm>
#include <string_view>

#include "experiments/report/export.hpp"
#include "experiments/report/renderers.hpp"

namespace croon::experiments {

namespace {

std::string cell_text(const Cell& cell, const Column& column) {
  const std::string text = markdown_escaped(shown_text(cell, column));
  return (cell.is_best ? "**" + text + "**" : text) +
         (cell.mark.empty() ? "" : " " + markdown_escaped(cell.mark));
}

std::string line_of(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

}  // namespace

std::string markdown_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (std::string_view("\\`*_[]<>|~&#").find(c) != std::string_view::npos) escaped += '\\';
    escaped += c == '\n' || c == '\r' ? ' ' : c;
  }
  return escaped;
}

std::string markdown_table(const Table& table, const View& view) {
  std::string text = line_of(titles_of(view)) + "|";
  for (std::size_t k = 0; k < view.columns.size(); ++k) text += k < view.names ? "---|" : "---:|";
  text += "\n";
  const std::vector<ShownCells> columns = shown_cells(table, view);
  for (const CellRow& row : table.rows) {
    std::vector<std::string> cells;
    for (const ShownCells& column : columns) cells.push_back(column.content(row, cell_text));
    text += line_of(cells);
  }
  return text;
}

std::string export_markdown(const ExportTable& table) {
  View view{{{"variant"},
             {"sensor"},
             {"success %", "<success_percent> [<success_low_percent>, <success_high_percent>]"}},
            2};
  for (const std::size_t k : {kRotation, kTranslation}) {
    for (const char* statistic : {"median", "p95"}) {
      const Measure& measure = kMeasures[k];
      view.columns.push_back({std::string(measure.name) + " " + statistic + " " + measure.unit,
                              content_of(measure, std::string("<") + statistic + ">")});
    }
  }
  add_dofs(view, "<mean> ± <std>");
  std::string text;
  for (const std::string& sentence : caption_sentences(table)) {
    text += markdown_escaped(sentence) + "\n";
  }
  return text + "Degrees of freedom: mean ± std.\n\n" + markdown_table(table.table, view);
}

}  // namespace croon::experiments

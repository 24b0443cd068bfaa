#include "experiments/report/export_formats.hpp"

namespace croon::experiments {

namespace {

std::string shown(const ExportRow& row, std::size_t k) {
  const ExportCell& cell = row.cells[k];
  const std::string text = shown_text(cell, export_columns()[k]);
  return (cell.is_best ? "**" + text + "**" : text) +
         (cell.mark.empty() ? "" : " " + markdown_escaped(cell.mark));
}

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

/// The names to the left, numbers to the right.
std::string rule(std::size_t columns) {
  std::string text = "|---|---|";
  for (std::size_t k = 2; k < columns; ++k) text += "---:|";
  return text + "\n";
}

std::vector<std::string> head() {
  std::vector<std::string> cells = {"variant", "sensor", "success %"};
  for (std::size_t k = kDofs; k < kMeasures.size(); ++k) {
    for (const char* statistic : {" median ", " p95 "}) {
      cells.push_back(kMeasures[k].name + std::string(statistic) + kMeasures[k].unit);
    }
  }
  for (const std::size_t k : kPaperOrder) {
    cells.push_back(std::string(kMeasures[k].name) + " " + kMeasures[k].unit);
  }
  return cells;
}

std::vector<std::string> cells_of(const ExportRow& row) {
  std::vector<std::string> cells = {
      markdown_escaped(row.variant),
      row.sensor.empty() ? "all sensors" : markdown_escaped(row.sensor),
      shown(row, kSuccessColumn) + " [" + shown(row, kIntervalColumn) + ", " +
          shown(row, kIntervalColumn + 1) + "]"};
  for (std::size_t k = kDistanceColumn; k < kFirstDofColumn; ++k) cells.push_back(shown(row, k));
  for (std::size_t k = kFirstDofColumn; k < row.cells.size(); k += 2) {
    cells.push_back(row.cells[k].value ? shown(row, k) + " ± " + shown(row, k + 1) : "-");
  }
  return cells;
}

}  // namespace

std::string export_markdown(const ExportTable& table) {
  std::string text;
  for (const std::string& sentence : caption_sentences(table)) {
    text += markdown_escaped(sentence) + "\n";
  }
  text += "Degrees of freedom: mean ± std.\n\n" + line(head()) + rule(head().size());
  for (const ExportRow& row : table.rows) text += line(cells_of(row));
  return text;
}

}  // namespace croon::experiments

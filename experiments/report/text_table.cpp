#include "experiments/report/text_table.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "experiments/report/text.hpp"

namespace croon::experiments {

namespace {

constexpr const char* kGap = "  ";

}  // namespace

TextTable::TextTable(std::vector<std::string> header, std::size_t names)
    : header_(std::move(header)), names_(names) {
  if (header_.size() < 2) throw std::logic_error("a table of less than two columns");
  for (const std::string& cell : header_) widths_.push_back(text_columns(cell));
}

void TextTable::add(std::vector<std::string> cells) {
  if (cells.size() != header_.size()) throw std::logic_error("a row that does not fit its table");
  for (std::size_t i = 0; i < cells.size(); ++i) {
    widths_[i] = std::max(widths_[i], text_columns(cells[i]));
  }
  rows_.push_back(std::move(cells));
}

void TextTable::add_heading(std::string text) { rows_.push_back({std::move(text)}); }

std::string TextTable::line(const std::vector<std::string>& cells) const {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += kGap;
    line += i < names_ ? left_aligned(cells[i], widths_[i]) : right_aligned(cells[i], widths_[i]);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line;
}

std::string TextTable::text(bool bold_header) const {
  std::vector<std::string> rules;
  for (const std::size_t width : widths_) rules.emplace_back(width, '-');
  std::string text = bold_header ? "\033[1m" + line(header_) + "\033[0m" : line(header_);
  text += "\n" + line(rules) + "\n";
  for (const std::vector<std::string>& row : rows_) {
    text += (row.size() == 1 ? row.front() : line(row)) + "\n";
  }
  return text;
}

}  // namespace croon::experiments

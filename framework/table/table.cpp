#include "framework/table/table.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/base/text.hpp"

namespace croon {

std::size_t Table::index_of(const std::string& full_name) const {
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (columns[k].full_name() == full_name) return k;
  }
  throw std::logic_error("unknown column \"" + full_name + "\"");
}

const std::string& Table::text_at(std::size_t row, const std::string& full_name) const {
  static const std::string kNothing;
  const std::string* const text = std::get_if<std::string>(&at(row, full_name).value);
  return text == nullptr ? kNothing : *text;
}

std::string shown_text(const Cell& cell, const Column& column) {
  if (cell.is_nothing()) return column.is_all_if_nothing ? "all " + column.name + "s" : "-";
  if (const auto* text = std::get_if<std::string>(&cell.value)) return *text;
  if (const auto* count = std::get_if<long long>(&cell.value)) return std::to_string(*count);
  if (const auto* is_true = std::get_if<bool>(&cell.value)) return *is_true ? "yes" : "no";
  const double value = std::get<double>(cell.value) * (column.unit == "ratio" ? 100.0 : 1.0);
  const int decimals = cell.decimals.value_or(column.decimals);
  return decimals == kAllDigits ? plain_number(value) : fixed_number(value, decimals);
}

View whole_view(const Table& table, std::size_t names) {
  View view;
  view.names = names;
  for (const Column& column : table.columns) view.columns.push_back({column.full_name()});
  return view;
}

View with_heading_as_column(View view) {
  if (view.heading.empty()) return view;
  view.columns.insert(view.columns.begin(), {view.heading});
  view.heading.clear();
  ++view.names;
  return view;
}

ShownCells::ShownCells(const Table& table, const Shown& shown)
    : table_(table), shows_each_(shown.shows_each) {
  after_ = shown.content.empty() ? "<" + shown.title + ">" : shown.content;
  for (std::size_t begin = after_.find('<'); begin != std::string::npos; begin = after_.find('<')) {
    const std::size_t end = after_.find('>', begin);
    const std::string name = after_.substr(begin + 1, end - begin - 1);
    const bool is_index = name.rfind('#', 0) == 0;
    pieces_.push_back(
        {after_.substr(0, begin), is_index ? std::stoul(name.substr(1)) : table.index_of(name)});
    after_.erase(0, end + 1);
  }
}

std::string ShownCells::content(const CellRow& row,
                                std::string (*text_of)(const Cell&, const Column&)) const {
  if (row.size() != table_.columns.size())
    throw std::logic_error("a row that does not fit its table");
  const auto is_nothing = [&](const Piece& piece) { return row[piece.column].is_nothing(); };
  const bool has_value = !std::all_of(pieces_.begin(), pieces_.end(), is_nothing);
  if (pieces_.size() > 1 && !has_value && !shows_each_) return "-";
  std::string text;
  for (const Piece& piece : pieces_) {
    text += piece.before + text_of(row[piece.column], table_.columns[piece.column]);
  }
  return text + after_;
}

std::vector<ShownCells> shown_cells(const Table& table, const View& view) {
  std::vector<ShownCells> cells;
  for (const Shown& shown : view.columns) cells.emplace_back(table, shown);
  return cells;
}

}  // namespace croon

#include "experiments/report/view.hpp"

#include <algorithm>

#include "framework/base/text.hpp"

namespace croon::experiments {

View whole_view(const Table& table, std::size_t names) {
  View view;
  view.names = names;
  for (const Column& column : table.columns) view.columns.push_back({column.full_name()});
  return view;
}

View view_by_variant(View view, const std::vector<std::string>& variants) {
  constexpr std::size_t kLongName = 16;
  if (variants.size() < 2) return view;
  const bool has_long_name =
      std::any_of(variants.begin(), variants.end(),
                  [](const std::string& name) { return text_columns(name) > kLongName; });
  if (has_long_name) {
    view.heading = "variant";
  } else {
    view.columns.insert(view.columns.begin(), {"variant"});
    ++view.names;
  }
  return view;
}

ShownCells::ShownCells(const Table& table, const Shown& shown)
    : table_(table), shows_each_(shown.shows_each) {
  after_ = shown.content.empty() ? "<" + shown.title + ">" : shown.content;
  for (std::size_t begin = after_.find('<'); begin != std::string::npos; begin = after_.find('<')) {
    const std::size_t end = after_.find('>', begin);
    const std::string name = after_.substr(begin + 1, end - begin - 1);
    pieces_.push_back({after_.substr(0, begin), table.index_of(name)});
    after_.erase(0, end + 1);
  }
}

bool ShownCells::is_empty(const CellRow& row) const {
  return !shows_each_ && pieces_.size() > 1 &&
         std::all_of(pieces_.begin(), pieces_.end(),
                     [&](const Piece& piece) { return row[piece.column].is_nothing(); });
}

std::vector<ShownCells> shown_cells(const Table& table, const View& view) {
  std::vector<ShownCells> cells;
  for (const Shown& shown : view.columns) cells.emplace_back(table, shown);
  return cells;
}

std::vector<std::string> titles_of(const View& view) {
  std::vector<std::string> titles;
  for (const Shown& shown : view.columns) titles.push_back(shown.title);
  return titles;
}

}  // namespace croon::experiments

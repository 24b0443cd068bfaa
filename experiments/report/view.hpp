#pragma once

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/report/table.hpp"

namespace croon::experiments {

/// A column as a reader sees it, of one or several columns of the table.
struct Shown {
  std::string title;
  /// What stands in a cell: "<pitch_mean_deg> ± <pitch_std_deg>" is the cells of two columns with
  /// text between; empty for the column that is called as the title is. Text is written as it is,
  /// in the language of the format.
  std::string content = {};
  bool shows_each = false;  ///< Shows "-" for each cell without a value, not one "-" for all.
  std::string group = {};   ///< A title above this and its neighbours of the same group (LaTeX).
};

/// The columns of a table that readers see, in their order.
struct View {
  std::vector<Shown> columns;
  std::size_t names = 1;     ///< The first columns, which are aligned to the left.
  std::string heading = {};  ///< A column whose text stands above the rows that share it.
  /// Longer names are cut (text only).
  std::size_t widest_name = std::numeric_limits<std::size_t>::max();
};

/// All columns of the table, under their own names.
View whole_view(const Table& table, std::size_t names = 1);

/// `view` of a table whose rows belong to `variants`: names the variant of each row in a column in
/// front; in a heading if a name is long; not at all if there is one variant.
View view_by_variant(View view, const std::vector<std::string>& variants);

/// A `Shown` whose columns were looked up in its table.
class ShownCells {
 public:
  struct Piece {
    std::string before;  ///< Text.
    std::size_t column;
  };

  /// Throws std::logic_error if the table lacks a column.
  ShownCells(const Table& table, const Shown& shown);

  const std::vector<Piece>& pieces() const { return pieces_; }

  /// The content of a row, each of its cells written by `text_of(cell, column)`; "-" if none
  /// of them has a value, unless each is shown.
  /// Throws std::logic_error if the row does not have a cell per column.
  template <class F>
  std::string content(const CellRow& row, const F& text_of) const {
    if (row.size() != table_.columns.size()) {
      throw std::logic_error("a row that does not fit its table");
    }
    if (is_empty(row)) return "-";
    std::string text;
    for (const Piece& piece : pieces_) {
      text += piece.before + text_of(row[piece.column], table_.columns[piece.column]);
    }
    return text + after_;
  }

 private:
  bool is_empty(const CellRow& row) const;

  const Table& table_;
  bool shows_each_;
  std::vector<Piece> pieces_;
  std::string after_;
};

/// The columns of `view`, looked up in `table`.
std::vector<ShownCells> shown_cells(const Table& table, const View& view);

/// The titles of the columns.
std::vector<std::string> titles_of(const View& view);

}  // namespace croon::experiments

#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace croon {

/// Which of two values of a column is better.
enum class Better { neither, greater, nearer_to_zero };

/// Text, a count, a number or nothing (std::monostate).
using Value = std::variant<std::monostate, bool, long long, double, std::string>;

/// Value of `Column::decimals` for all digits of a number.
inline constexpr int kAllDigits = -1;

/// A column of a table.
struct Column {
  std::string name;       ///< Without the unit: "pitch_mean".
  std::string unit = {};  ///< "deg"; a "ratio" is shown in percent.
  std::string path = {};  ///< JSON pointer to its value in a row; if empty, "/" and the full name.
  int decimals = 0;       ///< Of numbers, for readers; CSV and JSON have full precision.
  Better better = Better::neither;
  bool has_marks = false;          ///< Whether cells may have a mark; CSV has a column for them.
  bool is_all_if_nothing = false;  ///< Whether a cell without a value means all (sensors).

  /// "pitch_mean_deg": the header in CSV files, and its name in views.
  std::string full_name() const { return unit.empty() ? name : name + "_" + unit; }
};

/// A cell of a table.
struct Cell {
  Value value = {};
  std::optional<int> decimals = {};  ///< Overrides the decimals of the column.
  bool is_best = false;              ///< Whether it is the best among its competitors.
  std::string mark = {};             ///< Significance mark: "+*", "-**".

  bool is_nothing() const { return std::holds_alternative<std::monostate>(value); }
};

using CellRow = std::vector<Cell>;

/// Numbers and names in rows and columns, from which text, CSV, JSON, Markdown and LaTeX tables are
/// rendered.
struct Table {
  std::vector<Column> columns;
  std::vector<CellRow> rows;  ///< A cell per column.

  /// The index of the column with this full name. Throws std::logic_error if there is none.
  std::size_t index_of(const std::string& full_name) const;
  const Cell& at(std::size_t row, const std::string& full_name) const {
    return rows[row][index_of(full_name)];
  }
  /// The text in a cell; empty if it has no value.
  const std::string& text_at(std::size_t row, const std::string& full_name) const;
};

/// The displayed text of a cell: with the decimals of its column, ratios in percent, without its
/// mark; "-" without a value, or "all sensors" in a column where that means all.
std::string shown_text(const Cell& cell, const Column& column);

/// `value` as a cell: text, an integer, a number (NaN stays), an optional of them, or a Cell.
template <class T>
Cell to_cell(const T& value) {
  if constexpr (std::is_same_v<T, Cell>) {
    return value;
  } else if constexpr (std::is_constructible_v<std::string, T>) {
    return {Value(std::string(value))};
  } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, double>) {
    return {Value(value)};
  } else if constexpr (std::is_integral_v<T>) {
    return {Value(static_cast<long long>(value))};
  } else {
    return value ? to_cell(*value) : Cell();
  }
}

/// The values as the cells of a row.
template <class... T>
CellRow cell_row(const T&... values) {
  return {to_cell(values)...};
}

/// The text, or std::nullopt if it is empty.
inline std::optional<std::string> nothing_if_empty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional<std::string>(text);
}

/// The columns of tables whose rows come from objects of type `Row`.
template <class Row>
class Columns {
 public:
  using Function = std::function<Cell(const Row&)>;

  /// Adds a column; `value` is a member of `Row` or a function of a row, see `to_cell`.
  template <class F>
  Columns& add(Column column, F value) {
    columns_.push_back(std::move(column));
    functions_.push_back([value](const Row& row) { return to_cell(std::invoke(value, row)); });
    return *this;
  }

  /// Adds the columns of a part of each row: of a member or of the result of a function. If that is
  /// a std::optional without a value, the cells have no value.
  template <class Part, class F>
  Columns& add(const Columns<Part>& of_part, F part) {
    for (std::size_t k = 0; k < of_part.columns().size(); ++k) {
      columns_.push_back(of_part.columns()[k]);
      functions_.push_back([part, value = of_part.functions()[k]](const Row& row) {
        if constexpr (std::is_convertible_v<std::invoke_result_t<F, const Row&>, const Part&>) {
          return value(std::invoke(part, row));
        } else {
          const std::optional<Part>& found = std::invoke(part, row);
          return found ? value(*found) : Cell();
        }
      });
    }
    return *this;
  }

  /// Adds columns of the same row, or of a base class of it.
  template <class Base>
  Columns& add(const Columns<Base>& others) {
    return add(others, [](const Row& row) -> const Base& { return row; });
  }

  CellRow cells(const Row& row) const {
    CellRow cells;
    cells.reserve(functions_.size());
    for (const Function& function : functions_) cells.push_back(function(row));
    return cells;
  }

  Table table(const std::vector<Row>& rows) const {
    Table table{columns_, {}};
    for (const Row& row : rows) table.rows.push_back(cells(row));
    return table;
  }

  const std::vector<Column>& columns() const { return columns_; }
  const std::vector<Function>& functions() const { return functions_; }

 private:
  std::vector<Column> columns_;
  std::vector<Function> functions_;
};

/// A displayed column, made of one or several columns of the table.
struct Shown {
  std::string title;
  /// Template of a cell: "<pitch_mean_deg> ± <pitch_std_deg>" combines the cells of two columns
  /// with text in between, and "<#2>" is the third column, whatever its name; empty for the column
  /// named like the title. Text is written verbatim, in the language of the format.
  std::string content = {};
  /// Whether each cell without a value shows "-", instead of one "-" for all.
  bool shows_each = false;
  std::string group = {};  ///< A title above this and its neighbours of the same group (LaTeX).
};

/// The displayed columns of a table, in order.
struct View {
  std::vector<Shown> columns;
  std::size_t names = 1;  ///< Number of leading columns that are left-aligned.
  /// A column whose text is shown as a heading above the rows that share it: in LaTeX, and in text
  /// if it is long; elsewhere it is the first column.
  std::string heading = {};
  /// Maximum width of names, beyond which they are cut (text only).
  std::size_t max_name_columns = std::numeric_limits<std::size_t>::max();
};

/// All columns of the table, under their own names.
View whole_view(const Table& table, std::size_t names = 1);

/// The view with its heading, if it has one, as the first column.
View with_heading_as_column(View view);

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

  /// The content of a row, with each cell written by `text_of`; "-" if no cell has a value, unless
  /// `shows_each`. Throws std::logic_error if the row does not have one cell per column.
  std::string content(const CellRow& row, std::string (*text_of)(const Cell&, const Column&)) const;

 private:
  const Table& table_;
  bool shows_each_;
  std::vector<Piece> pieces_;
  std::string after_;
};

/// The columns of `view`, looked up in `table`.
std::vector<ShownCells> shown_cells(const Table& table, const View& view);

}  // namespace croon

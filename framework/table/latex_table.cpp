#include <algorithm>
#include <string_view>

#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon {

namespace {

/// Maximum length of a name in one line; longer names are broken.
constexpr std::size_t kLongName = 22;

/// The name with permitted LaTeX line breaks after its punctuation.
std::string breakable(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    text += latex_escaped(std::string(1, name[i]));
    // Not inside numbers such as 0.05.
    const bool is_in_number = i + 1 < name.size() && name[i + 1] >= '0' && name[i + 1] <= '9';
    if (std::string_view("/_=,").find(name[i]) != std::string_view::npos ||
        (name[i] == '.' && !is_in_number))
      text += "\\allowbreak{}";
  }
  return text;
}

std::string spanning(std::size_t columns, const std::string& text) {
  return " & \\multicolumn{" + std::to_string(columns) + "}{c}{" + text + "}";
}

/// Rows of a table from `begin` to before `end`.
struct RowRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Tabulars of the rows of one table, with booktabs rules and siunitx columns (version 2 or 3), the
/// best values bold. The first column of the view has names, the others numbers.
class Tabular {
 public:
  Tabular(const Table& table, const View& view)
      : table_(table), view_(view), cells_(shown_cells(table, view)) {
    const std::size_t k = cells_.front().pieces().front().column;
    for (const CellRow& row : table.rows) names_.push_back(shown_text(row[k], table.columns[k]));
    has_long_name_ = std::any_of(names_.begin(), names_.end(), [](const std::string& name) {
      return text_columns(name) > kLongName;
    });
  }

  std::string text(const RowRange& rows) const {
    std::string text = "\\begin{tabular}{" + specification() + "}\n" + header();
    for (std::size_t i = rows.begin; i < rows.end; ++i) {
      if (!view_.heading.empty() && (i == rows.begin || begins_group(i))) {
        text += (i > rows.begin ? "\\addlinespace\n" : "") + heading(i);
      }
      text += (has_long_name_ ? breakable(names_[i]) : latex_escaped(names_[i])) + numbers(i);
    }
    return text + "\\bottomrule\n\\end{tabular}\n";
  }

  /// The rows, divided into pages.
  std::vector<RowRange> pages() const {
    constexpr std::size_t kLinesPerPage = 56;  // Without the header and a caption.
    std::vector<RowRange> pages = {{0, 0}};
    std::size_t total = 0;
    for (std::size_t row = 0; row < names_.size(); ++row) {
      total += lines(row);
      if (total > kLinesPerPage && pages.back().end > pages.back().begin) {
        pages.push_back({row, row});
        total = lines(row);
      }
      pages.back().end = row + 1;
    }
    return pages;
  }

 private:
  /// The number of lines of a row, including a heading above it.
  std::size_t lines(std::size_t row) const {
    const bool has_heading = !view_.heading.empty() && begins_group(row);
    return 1 + text_columns(names_[row]) / kLongName + (has_heading ? 1 : 0);
  }

  /// Marks are in a separate column, so that they do not shift numbers in any version of siunitx.
  bool has_marks(std::size_t k) const {
    return std::any_of(table_.rows.begin(), table_.rows.end(),
                       [k](const CellRow& row) { return !row[k].mark.empty(); });
  }

  /// The number of LaTeX columns of the shown columns from `begin` to before `end`.
  std::size_t width(std::size_t begin, std::size_t end) const {
    std::size_t width = 0;
    for (std::size_t k = begin; k < end; ++k) {
      for (const auto& piece : cells_[k].pieces()) width += has_marks(piece.column) ? 2 : 1;
    }
    return width;
  }

  std::string number_format(std::size_t k) const {
    std::size_t digits = 1;
    bool has_sign = false;
    for (const CellRow& row : table_.rows) {
      if (row[k].is_nothing()) continue;
      const std::string text = shown_text(row[k], table_.columns[k]);
      const bool is_negative = text[0] == '-';
      has_sign = has_sign || is_negative;
      digits = std::max(digits, text.find('.') - (is_negative ? 1U : 0U));
    }
    return "S[table-format=" + std::string(has_sign ? "-" : "") + std::to_string(digits) + "." +
           std::to_string(table_.columns[k].decimals) + "]";
  }

  std::string specification() const {
    std::string text = "@{}l";
    if (has_long_name_) {
      text = "@{}>{\\raggedright\\arraybackslash}p{" + shortest_number(kLatexNameShare) +
             "\\linewidth}";
    }
    for (std::size_t k = 1; k < cells_.size(); ++k) {
      for (const auto& piece : cells_[k].pieces()) {
        if (!piece.before.empty()) text += "@{" + piece.before + "}";
        text += "\n  " + number_format(piece.column);
        if (has_marks(piece.column)) text += "@{\\,}l";
      }
    }
    return text + "@{}";
  }

  std::string header() const {
    std::string groups;
    std::string rules;
    std::string titles = view_.columns.front().title;
    std::size_t first = 2;
    for (std::size_t begin = 1, end = 1; begin < cells_.size(); begin = end) {
      const std::string& group = view_.columns[begin].group;
      for (; end < cells_.size() && view_.columns[end].group == group; ++end) {
        titles += spanning(width(end, end + 1), view_.columns[end].title);
      }
      const std::size_t next = first + width(begin, end);
      groups += spanning(next - first, group);
      if (!group.empty())
        rules += "\\cmidrule(lr){" + std::to_string(first) + "-" + std::to_string(next - 1) + "}";
      first = next;
    }
    return "\\toprule\n" + groups + " \\\\\n" + rules + "\n" + titles + " \\\\\n\\midrule\n";
  }

  bool begins_group(std::size_t row) const {
    return row == 0 || table_.text_at(row, view_.heading) != table_.text_at(row - 1, view_.heading);
  }

  std::string heading(std::size_t row) const {
    const std::size_t k = table_.index_of(view_.heading);
    return "\\multicolumn{" + std::to_string(1 + width(1, cells_.size())) + "}{@{}l}{\\itshape " +
           latex_escaped(shown_text(table_.rows[row][k], table_.columns[k])) +
           (begins_group(row) ? "" : ", continued") + "} \\\\\n";
  }

  /// The mark with a minus instead of a hyphen.
  static std::string latex_mark(const std::string& mark) {
    return mark.empty() || mark[0] != '-' ? mark : "$-$" + mark.substr(1);
  }

  std::string numbers(std::size_t row) const {
    std::string text;
    for (std::size_t k = 1; k < cells_.size(); ++k) {
      const auto& pieces = cells_[k].pieces();
      const auto is_nothing = [&](const auto& piece) {
        return table_.rows[row][piece.column].is_nothing();
      };
      if (pieces.size() > 1 && std::all_of(pieces.begin(), pieces.end(), is_nothing)) {
        text += " & \\multicolumn{" + std::to_string(width(k, k + 1)) + "}{c}{--}";
        continue;
      }
      for (const auto& piece : pieces) {
        const Cell& cell = table_.rows[row][piece.column];
        const std::string number = shown_text(cell, table_.columns[piece.column]);
        text += " & " + (number == "-" ? "{--}" : (cell.is_best ? "\\bfseries " : "") + number);
        if (has_marks(piece.column)) text += " & " + latex_mark(cell.mark);
      }
    }
    return text + " \\\\\n";
  }

  const Table& table_;
  const View& view_;
  std::vector<ShownCells> cells_;
  std::vector<std::string> names_;
  bool has_long_name_ = false;
};

}  // namespace

std::vector<std::string> latex_pages(const Table& table, const View& view) {
  const Tabular tabular(table, view);
  std::vector<std::string> pages;
  for (const RowRange& rows : tabular.pages()) pages.push_back(tabular.text(rows));
  return pages;
}

std::string latex_tabular(const Table& table, const View& wanted) {
  const View view = with_heading_as_column(wanted);
  const std::vector<ShownCells> columns = shown_cells(table, view);
  const auto line = [&](const auto& text_of) {
    std::string text;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      text += (k > 0 ? " & " : "") + latex_escaped(one_line(text_of(k)));
    }
    return text + " \\\\\n";
  };
  const auto plain = [](const Cell& cell, const Column& column) {
    return shown_text(cell, column) + cell.mark;
  };
  const std::size_t names = std::min(view.names, columns.size());
  std::string text = "\\begin{tabular}{" + std::string(names, 'l') +
                     std::string(columns.size() - names, 'r') + "}\n\\toprule\n" +
                     line([&](std::size_t k) { return view.columns[k].title; }) + "\\midrule\n";
  for (const CellRow& row : table.rows) {
    text += line([&](std::size_t k) { return columns[k].content(row, plain); });
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace croon

#include <algorithm>
#include <string_view>

#include "experiments/report/renderers.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {

namespace {

/// A name that is longer is broken into lines.
constexpr std::size_t kLongName = 22;

bool is_one_of(std::string_view characters, char c) {
  return characters.find(c) != std::string_view::npos;
}

const char* latex_command(char c) {
  switch (c) {
    case '\\':
      return "\\textbackslash{}";
    case '^':
      return "\\textasciicircum{}";
    case '~':
      return "\\textasciitilde{}";
    case '<':
      return "\\textless{}";
    case '>':
      return "\\textgreater{}";
    case '|':
      return "\\textbar{}";
    default:
      return nullptr;
  }
}

/// The name with places at which LaTeX may break it: after its punctuation.
std::string breakable(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    text += latex_escaped(name.substr(i, 1));
    // Not inside 0.05.
    const bool is_in_number = i + 1 < name.size() && name[i + 1] >= '0' && name[i + 1] <= '9';
    if (is_one_of("/_=,", name[i]) || (name[i] == '.' && !is_in_number)) text += "\\allowbreak{}";
  }
  return text;
}

std::string spanning(std::size_t columns, const std::string& text) {
  return " & \\multicolumn{" + std::to_string(columns) + "}{c}{" + text + "}";
}

/// A tabular of the rows of one table.
class Tabular {
 public:
  Tabular(const Table& table, const View& view)
      : table_(table),
        view_(view),
        cells_(shown_cells(table, view)),
        names_(cells_.front().pieces().front().column) {}

  std::string text(const RowRange& rows) const {
    std::string text = "\\begin{tabular}{" + specification() + "}\n" + header();
    for (std::size_t i = rows.begin; i < rows.end; ++i) {
      if (!view_.heading.empty() && (i == rows.begin || begins_group(i))) {
        text += (i > rows.begin ? "\\addlinespace\n" : "") + heading(i);
      }
      text += name(i) + numbers(i);
    }
    return text + "\\bottomrule\n\\end{tabular}\n";
  }

  std::size_t lines(std::size_t row) const {
    const bool has_heading = !view_.heading.empty() && begins_group(row);
    return 1 + text_columns(name_text(row)) / kLongName + (has_heading ? 1 : 0);
  }

 private:
  /// Marks are in a column of their own, so that they move no number in any version of siunitx.
  bool has_marks(std::size_t k) const {
    return std::any_of(table_.rows.begin(), table_.rows.end(),
                       [k](const CellRow& row) { return !row[k].mark.empty(); });
  }

  /// The number of LaTeX columns of shown column `k`.
  std::size_t width(std::size_t k) const {
    std::size_t width = 0;
    for (const auto& piece : cells_[k].pieces()) width += has_marks(piece.column) ? 2 : 1;
    return width;
  }

  std::string name_text(std::size_t row) const {
    return shown_text(table_.rows[row][names_], table_.columns[names_]);
  }

  bool has_long_name() const {
    for (std::size_t i = 0; i < table_.rows.size(); ++i) {
      if (text_columns(name_text(i)) > kLongName) return true;
    }
    return false;
  }

  std::string number_format(std::size_t k) const {
    const Column& column = table_.columns[k];
    std::size_t digits = 1;
    bool has_sign = false;
    for (const CellRow& row : table_.rows) {
      if (row[k].is_nothing()) continue;
      const std::string text = shown_text(row[k], column);
      const bool is_negative = text[0] == '-';
      has_sign = has_sign || is_negative;
      digits = std::max(digits, text.find('.') - (is_negative ? 1U : 0U));
    }
    return "S[table-format=" + std::string(has_sign ? "-" : "") + std::to_string(digits) + "." +
           std::to_string(column.decimals) + "]";
  }

  std::string specification() const {
    std::string text =
        has_long_name() ? "@{}>{\\raggedright\\arraybackslash}p{0.16\\linewidth}" : "@{}l";
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
      std::size_t columns = 0;
      for (; end < cells_.size() && view_.columns[end].group == view_.columns[begin].group; ++end) {
        columns += width(end);
        titles += spanning(width(end), view_.columns[end].title);
      }
      groups += spanning(columns, view_.columns[begin].group);
      rules += "\\cmidrule(lr){" + std::to_string(first) + "-" +
               std::to_string(first + columns - 1) + "}";
      first += columns;
    }
    return "\\toprule\n" + groups + " \\\\\n" + rules + "\n" + titles + " \\\\\n\\midrule\n";
  }

  bool begins_group(std::size_t row) const {
    return row == 0 || table_.text_at(row, view_.heading) != table_.text_at(row - 1, view_.heading);
  }

  std::string heading(std::size_t row) const {
    std::size_t columns = 1;
    for (std::size_t k = 1; k < cells_.size(); ++k) columns += width(k);
    const std::size_t k = table_.index_of(view_.heading);
    return "\\multicolumn{" + std::to_string(columns) + "}{@{}l}{\\itshape " +
           latex_escaped(shown_text(table_.rows[row][k], table_.columns[k])) +
           (begins_group(row) ? "" : ", continued") + "} \\\\\n";
  }

  std::string name(std::size_t row) const {
    const std::string text = name_text(row);
    return has_long_name() ? breakable(text) : latex_escaped(text);
  }

  std::string numbers(std::size_t row) const {
    std::string text;
    for (std::size_t k = 1; k < cells_.size(); ++k) {
      for (const auto& piece : cells_[k].pieces()) {
        const Cell& cell = table_.rows[row][piece.column];
        const std::string number = shown_text(cell, table_.columns[piece.column]);
        text += " & " + (number == "-" ? "{--}" : (cell.is_best ? "\\bfseries " : "") + number);
        if (has_marks(piece.column)) text += " & " + cell.mark;
      }
    }
    return text + " \\\\\n";
  }

  const Table& table_;
  const View& view_;
  std::vector<ShownCells> cells_;
  std::size_t names_;  ///< The column of the names.
};

}  // namespace

std::string latex_escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (const char* command = latex_command(c)) {
      escaped += command;
    } else if (is_one_of("{}$&#_%", c)) {
      escaped += std::string("\\") + c;
    } else if (is_one_of("[]*-`'", c)) {
      // At the end of a line "[" and "*" begin its options; two of the others form another sign.
      escaped += std::string("{") + c + "}";
    } else {
      escaped += c == '\n' || c == '\r' ? ' ' : c;
    }
  }
  return escaped;
}

std::string latex_tabular(const Table& table, const View& view, const RowRange& rows) {
  return Tabular(table, view).text(rows);
}

std::size_t latex_lines(const Table& table, const View& view, std::size_t row) {
  return Tabular(table, view).lines(row);
}

}  // namespace croon::experiments

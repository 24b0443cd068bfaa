#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "experiments/report/export.hpp"
#include "experiments/report/renderers.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/text.hpp"

namespace croon::experiments {

namespace {

/// A name that is longer is broken into lines.
constexpr std::size_t kLongName = 22;

bool is_one_of(std::string_view characters, char c) {
  return characters.find(c) != std::string_view::npos;
}

/// `c` as LaTeX prints it.
std::string escaped(char c) {
  static const std::map<char, const char*> commands = {{'\\', "\\textbackslash{}"},
                                                       {'^', "\\textasciicircum{}"},
                                                       {'~', "\\textasciitilde{}"},
                                                       {'<', "\\textless{}"},
                                                       {'>', "\\textgreater{}"},
                                                       {'|', "\\textbar{}"},
                                                       {'\n', " "},
                                                       {'\r', " "}};
  if (const auto command = commands.find(c); command != commands.end()) return command->second;
  if (is_one_of("{}$&#_%", c)) return std::string("\\") + c;
  // At the end of a line "[" and "*" begin its options; two of the others form another sign.
  if (is_one_of("[]*-`'", c)) return std::string("{") + c + "}";
  return std::string(1, c);
}

/// The name with places at which LaTeX may break it: after its punctuation.
std::string breakable(const std::string& name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    text += escaped(name[i]);
    // Not inside 0.05.
    const bool is_in_number = i + 1 < name.size() && name[i + 1] >= '0' && name[i + 1] <= '9';
    if (is_one_of("/_=,", name[i]) || (name[i] == '.' && !is_in_number)) text += "\\allowbreak{}";
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
/// best values bold. The first column of the view is names, the others have numbers.
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

  /// The rows, as many together as a page holds.
  std::vector<RowRange> floats() const {
    constexpr std::size_t kLinesPerFloat = 28;  // With two panels, their heads and a caption.
    std::vector<RowRange> floats = {{0, 0}};
    std::size_t total = 0;
    for (std::size_t row = 0; row < names_.size(); ++row) {
      total += lines(row);
      if (total > kLinesPerFloat && floats.back().end > floats.back().begin) {
        floats.push_back({row, row});
        total = lines(row);
      }
      floats.back().end = row + 1;
    }
    return floats;
  }

 private:
  /// The lines that the row takes, with the heading above it if it has one.
  std::size_t lines(std::size_t row) const {
    const bool has_heading = !view_.heading.empty() && begins_group(row);
    return 1 + text_columns(names_[row]) / kLongName + (has_heading ? 1 : 0);
  }

  /// Marks are in a column of their own, so that they move no number in any version of siunitx.
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
    std::string text =
        has_long_name_ ? "@{}>{\\raggedright\\arraybackslash}p{0.16\\linewidth}" : "@{}l";
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
  std::vector<std::string> names_;
  bool has_long_name_ = false;
};

/// The two panels of an export, one above the other, because a page is too narrow for all columns.
std::array<View, 2> panels_of(const ExportTable& table) {
  const bool has_several = table.variants.size() > 1;
  View success{{{has_several || table.sensors.size() == 1 ? "variant" : "sensor"}}};
  if (has_several && table.sensors.size() > 1) success.heading = "sensor";
  View dofs = success;
  const auto add = [](View& view, std::size_t k, const char* title, const char* content) {
    const Measure& measure = kMeasures[k];
    const std::string unit = measure.unit == std::string("m") ? " (m)" : " ($^\\circ$)";
    view.columns.push_back({title, content_of(measure, content), false, measure.name + unit});
  };
  const std::string group = "success (\\%)";
  success.columns.push_back({"rate", "<success_percent>", false, group});
  success.columns.push_back(
      {"95\\,\\% interval", "<success_low_percent>\\,--\\,<success_high_percent>", false, group});
  for (const std::size_t k : kDistances) {
    add(success, k, "median", "<median>");
    add(success, k, "p95", "<p95>");
  }
  for (const std::size_t k : kPaperOrder) {
    add(dofs, k, "mean $\\pm$ std", "<mean>\\,${}\\pm{}$\\,<std>");
  }
  return {success, dofs};
}

/// Letters, digits and what labels may have besides.
std::string label(std::string name) {
  for (char& c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') ||
                          std::string_view("_.:-").find(c) != std::string_view::npos;
    if (!is_plain) c = '-';
  }
  return "tab:" + name;
}

/// The first float has the caption and the label; the others have its number.
std::string caption_of(const ExportTable& table, const RowRange& rows) {
  if (rows.begin > 0) {
    return "\\addtocounter{table}{-1}\n\\caption{" + latex_escaped(table.caption.name) +
           ", continued.}\n";
  }
  std::string text;
  for (const std::string& sentence : caption_sentences(table)) {
    text += (text.empty() ? "" : "\n  ") + latex_escaped(sentence);
  }
  return "\\caption{" + text + "}\n\\label{" + label(table.caption.name) + "}\n";
}

}  // namespace

std::string latex_escaped(const std::string& text) {
  std::string latex;
  for (const char c : text) latex += escaped(c);
  return latex;
}

std::string export_latex(const ExportTable& table) {
  const auto panels = panels_of(table);
  const Tabular success(table.table, panels[0]);
  const Tabular dofs(table.table, panels[1]);
  std::string text =
      "% Wants in the preamble: \\usepackage{booktabs,etoolbox,siunitx}\n"
      "% siunitx 2 or 3. Spans both columns of a page that has two.\n";
  for (const RowRange& rows : success.floats()) {
    text +=
        "\\begin{table*}[tbp]\n"
        "\\centering\n"
        "\\scriptsize\n"
        "\\setlength{\\tabcolsep}{2.5pt}\n"
        "\\robustify\\bfseries\n"
        "\\sisetup{detect-weight=true}\n" +
        caption_of(table, rows) + success.text(rows) + "\n\\medskip\n\n" + dofs.text(rows) +
        "\\end{table*}\n";
  }
  return text;
}

}  // namespace croon::experiments

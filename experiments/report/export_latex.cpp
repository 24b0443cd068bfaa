#include <algorithm>
#include <cmath>
#include <string_view>

#include "experiments/report/export_choice.hpp"
#include "experiments/report/plots.hpp"
#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

namespace {

/// Whether the rows of the table differ in `column`.
bool has_several(const Table& table, const char* column) {
  const std::size_t k = table.index_of(column);
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const CellRow& row) {
    return row[k].value != table.rows.front()[k].value;
  });
}

Shown latex_column(const ExportColumn& column) {
  const bool is_spread = column.statistic == kMeanAndStd;
  std::string content = "<" + column.columns.front() + ">";
  if (column.columns.size() > 1) {
    content += (is_spread ? "\\,${}\\pm{}$\\,<" : "\\,to\\,<") + column.columns.back() + ">";
  }
  const std::string title = is_spread                            ? "mean $\\pm$ std"
                            : column.statistic == kShareInterval ? "95\\,\\% interval"
                                                                 : column.statistic;
  ExportColumn in_latex = column;
  if (column.unit == "deg") in_latex.unit = "$^\\circ$";
  if (column.unit == "%") in_latex.unit = "\\%";
  return {title, content, false, in_latex.group()};
}

/// Throws InputError if a table with these names in front is wider than its page.
void refuse_too_wide(const ExportTable& table, const std::string& names) {
  // \scriptsize of a document of 10 pt is 7 pt; a digit of Computer Modern is 4 pt wide.
  constexpr double kDigit_mm = 4.0 / kPointsPerMm;
  constexpr double kLetter_mm = 3.5 / kPointsPerMm;
  constexpr double kSeparation_mm = 5.0 / kPointsPerMm;
  constexpr double kJoint_mm = 8.0 / kPointsPerMm;  // "±" or "to" with the space around it.
  const double page = table.is_one_column ? kOneColumn_mm : kTwoColumns_mm;
  const auto max_width_mm = [&](const std::string& column, bool of_marks) {
    const std::size_t k = table.table.index_of(column);
    std::size_t width = 0;
    for (const CellRow& row : table.table.rows) {
      const std::string text = of_marks ? row[k].mark : shown_text(row[k], table.table.columns[k]);
      width = std::max(width, text_columns(text));
    }
    return kDigit_mm * static_cast<double>(width);
  };
  const auto title_mm = [&](const std::string& title) {
    return kLetter_mm * static_cast<double>(text_columns(title));
  };
  double width = std::min(max_width_mm(names, false), kLatexNameShare * page);
  double of_group = 0.0;  // Neighbouring columns with a common title.
  const std::vector<ExportColumn> shown = shown_columns(table);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    double cells = shown[i].columns.size() > 1 ? kJoint_mm : 0.0;
    for (const std::string& column : shown[i].columns) {
      const double marks = max_width_mm(column, true);
      cells += max_width_mm(column, false) + marks + (marks > 0.0 ? kSeparation_mm : 0.0);
    }
    of_group += kSeparation_mm + std::max(cells, title_mm(shown[i].statistic));
    if (i + 1 < shown.size() && shown[i + 1].group() == shown[i].group()) continue;
    const std::string group = shown[i].subject.empty() ? "" : shown[i].subject + " (m)";
    width += std::max(of_group, kSeparation_mm + title_mm(group));  // Every unit is about as wide.
    of_group = 0.0;
  }
  constexpr double kUsablePage = 0.97;  // The estimate may be too low.
  if (width <= kUsablePage * page) return;
  throw InputError("", "--columns",
                   "these " + std::to_string(shown.size()) + " columns need about " +
                       fixed_number(std::ceil(width), 0) + " mm; the page is " +
                       fixed_number(kUsablePage * page, 0) + " mm wide; choose fewer" +
                       (table.is_one_column ? " or --width two_columns" : ""));
}

/// The pages of the table, each a tabular, with the experiment and the sensor, where there are
/// several, as headings.
std::vector<std::string> pages_of(const ExportTable& table) {
  const bool has_sensors = has_several(table.table, "sensor");
  const bool has_variants = has_several(table.table, "variant");
  View view{{{has_sensors && !has_variants ? "sensor" : "variant"}}};
  refuse_too_wide(table, view.columns.front().title);
  for (const ExportColumn& column : shown_columns(table)) {
    view.columns.push_back(latex_column(column));
  }
  const bool has_sensor_headings = has_sensors && has_variants;
  if (has_sensor_headings || !table.parts.empty()) view.heading = "heading";
  Table result = table.table;
  const std::size_t sensor = result.index_of("sensor");
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    std::string heading = table.parts.empty() ? "" : table.table.text_at(i, "experiment");
    if (has_sensor_headings) {
      heading += (heading.empty() ? "" : ", ") +
                 shown_text(result.rows[i][sensor], result.columns[sensor]);
    }
    result.rows[i].push_back(to_cell(heading));
  }
  result.columns.push_back({"heading"});
  return latex_pages(result, view);
}

/// A LaTeX label: characters that labels must not contain become "-".
std::string label(std::string name) {
  for (char& c : name) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') ||
                          std::string_view("_.:-").find(c) != std::string_view::npos;
    if (!is_plain) c = '-';
  }
  return "tab:" + name;
}

/// Only the first float has the caption and the label; the others repeat its number.
std::string latex_caption(const ExportTable& table, bool is_first) {
  if (!is_first) {
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

std::string export_latex(const ExportTable& table) {
  std::string text = "% Requires in the preamble: \\usepackage{booktabs,etoolbox,siunitx}\n";
  text += table.is_one_column ? "% siunitx 2 or 3. For one column of a two-column page.\n"
                              : "% siunitx 2 or 3. Spans both columns of a two-column page.\n";
  const std::string environment = table.is_one_column ? "table" : "table*";
  bool is_first = true;
  for (const std::string& page : pages_of(table)) {
    text += "\\begin{" + environment +
            "}[tbp]\n"
            "\\centering\n"
            "\\scriptsize\n"
            "\\setlength{\\tabcolsep}{2.5pt}\n"
            "\\robustify\\bfseries\n"
            "\\sisetup{detect-weight=true,group-minimum-digits=9}\n"
            "\\setlength{\\belowcaptionskip}{4pt}\n" +
            latex_caption(table, is_first) + page + "\\end{" + environment + "}\n";
    is_first = false;
  }
  return text;
}

}  // namespace croon::experiments

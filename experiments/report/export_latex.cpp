#include <algorithm>
#include <string_view>

#include "experiments/report/export_formats.hpp"
#include "experiments/report/text.hpp"

namespace croon::experiments {

namespace {

/// A name that is longer is broken into lines.
constexpr std::size_t kLongName = 32;

/// Numbers under one head, as "0.010 ± 0.003".
struct Head {
  std::string title;
  std::vector<std::size_t> columns;
  std::string between;
};

struct Group {
  std::string title;
  std::vector<Head> heads;
};

/// A page is too narrow for all columns, so they are two tables one above the other.
using Panel = std::vector<Group>;

std::string unit_of(const Measure& measure) {
  return std::string(measure.unit) == "m" ? " (m)" : " ($^\\circ$)";
}

Panel success_panel() {
  Panel panel = {{"success (\\%)",
                  {{"rate", {kSuccessColumn}, ""},
                   {"95\\,\\% interval", {kIntervalColumn, kIntervalColumn + 1}, "\\,--\\,"}}}};
  for (std::size_t i = 0; i < 2; ++i) {
    const Measure& measure = kMeasures[kDofs + i];
    const std::size_t k = kDistanceColumn + 2 * i;
    panel.push_back({measure.name + unit_of(measure), {{"median", {k}, ""}, {"p95", {k + 1}, ""}}});
  }
  return panel;
}

Panel dof_panel() {
  Panel panel;
  for (std::size_t i = 0; i < kDofs; ++i) {
    const Measure& measure = kMeasures[kPaperOrder[i]];
    const std::size_t k = kFirstDofColumn + 2 * i;
    panel.push_back(
        {measure.name + unit_of(measure), {{"mean $\\pm$ std", {k, k + 1}, "\\,${}\\pm{}$\\,"}}});
  }
  return panel;
}

/// Marks stand in a column of their own, so that they move no number in any version of siunitx.
bool has_marks(const ExportTable& table, std::size_t k) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [k](const ExportRow& row) { return !row.cells[k].mark.empty(); });
}

/// How many columns of LaTeX.
std::size_t width(const ExportTable& table, const Head& head) {
  const auto marks = std::count_if(head.columns.begin(), head.columns.end(),
                                   [&](std::size_t k) { return has_marks(table, k); });
  return head.columns.size() + static_cast<std::size_t>(marks);
}

std::size_t width(const ExportTable& table, const Group& group) {
  std::size_t sum = 0;
  for (const Head& head : group.heads) sum += width(table, head);
  return sum;
}

std::string number_column(const ExportTable& table, std::size_t k) {
  const ExportColumn& column = export_columns()[k];
  std::size_t digits = 1;
  bool has_sign = false;
  for (const ExportRow& row : table.rows) {
    if (!row.cells[k].value) continue;
    const std::string text = shown_text(row.cells[k], column);
    const bool is_negative = text[0] == '-';
    has_sign = has_sign || is_negative;
    digits = std::max(digits, text.find('.') - (is_negative ? 1U : 0U));
  }
  return "S[table-format=" + std::string(has_sign ? "-" : "") + std::to_string(digits) + "." +
         std::to_string(column.decimals) + "]";
}

std::string column_specification(const ExportTable& table, const Panel& panel) {
  const bool has_long_name =
      std::any_of(table.variants.begin(), table.variants.end(),
                  [](const std::string& name) { return text_columns(name) > kLongName; });
  std::string text =
      has_long_name ? "@{}>{\\raggedright\\arraybackslash}p{0.22\\linewidth}" : "@{}l";
  for (const Group& group : panel) {
    for (const Head& head : group.heads) {
      for (std::size_t i = 0; i < head.columns.size(); ++i) {
        if (i > 0) text += "@{" + head.between + "}";
        text += "\n  " + number_column(table, head.columns[i]);
        if (has_marks(table, head.columns[i])) text += "@{\\,}l";
      }
    }
  }
  return text + "@{}";
}

std::string spanning(std::size_t columns, const std::string& text) {
  return " & \\multicolumn{" + std::to_string(columns) + "}{c}{" + text + "}";
}

bool names_variants(const ExportTable& table) {
  return table.variants.size() > 1 || table.sensors.size() == 1;
}

std::string panel_header(const ExportTable& table, const Panel& panel) {
  std::string titles;
  std::string rules;
  std::string heads = names_variants(table) ? "variant" : "sensor";
  std::size_t first = 2;
  for (const Group& group : panel) {
    const std::size_t columns = width(table, group);
    titles += spanning(columns, group.title);
    rules +=
        "\\cmidrule(lr){" + std::to_string(first) + "-" + std::to_string(first + columns - 1) + "}";
    first += columns;
    for (const Head& head : group.heads) heads += spanning(width(table, head), head.title);
  }
  return "\\toprule\n" + titles + " \\\\\n" + rules + "\n" + heads + " \\\\\n\\midrule\n";
}

std::string cell_text(const ExportCell& cell, std::size_t k) {
  if (!cell.value) return "{--}";
  return (cell.is_best ? "\\bfseries " : "") + shown_text(cell, export_columns()[k]);
}

std::string panel_row(const ExportTable& table, const Panel& panel, const ExportRow& row) {
  std::string text;
  for (const Group& group : panel) {
    for (const Head& head : group.heads) {
      for (const std::size_t k : head.columns) {
        text += " & " + cell_text(row.cells[k], k);
        if (has_marks(table, k)) text += " & " + row.cells[k].mark;
      }
    }
  }
  return text + " \\\\\n";
}

std::string sensor_name(const ExportRow& row) {
  return row.sensor.empty() ? "all sensors" : latex_escaped(row.sensor);
}

std::string panel_rows(const ExportTable& table, const Panel& panel) {
  const bool has_headings = table.variants.size() > 1 && table.sensors.size() > 1;
  std::size_t columns = 1;
  for (const Group& group : panel) columns += width(table, group);
  std::string text;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const ExportRow& row = table.rows[i];
    const bool begins_sensor = i == 0 || row.sensor != table.rows[i - 1].sensor;
    if (has_headings && begins_sensor) {
      text += (i > 0 ? "\\addlinespace\n" : "") + std::string("\\multicolumn{") +
              std::to_string(columns) + "}{@{}l}{\\itshape " + sensor_name(row) + "} \\\\\n";
    }
    text += names_variants(table) ? latex_escaped(row.variant) : sensor_name(row);
    text += panel_row(table, panel, row);
  }
  return text;
}

std::string panel_text(const ExportTable& table, const Panel& panel) {
  return "\\begin{tabular}{" + column_specification(table, panel) + "}\n" +
         panel_header(table, panel) + panel_rows(table, panel) + "\\bottomrule\n\\end{tabular}\n";
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

std::string caption_text(const ExportTable& table) {
  std::string text;
  for (const std::string& sentence : caption_sentences(table)) {
    text += (text.empty() ? "" : "\n  ") + latex_escaped(sentence);
  }
  return text;
}

}  // namespace

std::string export_latex(const ExportTable& table) {
  return "% Wants in the preamble: \\usepackage{booktabs,etoolbox,siunitx}\n"
         "% siunitx 2 or 3. Spans both columns of a page that has two.\n"
         "\\begin{table*}[tbp]\n"
         "\\centering\n"
         "\\scriptsize\n"
         "\\setlength{\\tabcolsep}{4pt}\n"
         "\\robustify\\bfseries\n"
         "\\sisetup{detect-weight=true}\n"
         "\\caption{" +
         caption_text(table) + "}\n\\label{" + label(table.caption.name) + "}\n" +
         panel_text(table, success_panel()) + "\n\\medskip\n\n" + panel_text(table, dof_panel()) +
         "\\end{table*}\n";
}

}  // namespace croon::experiments

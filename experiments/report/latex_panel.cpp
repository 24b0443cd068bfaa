#include "experiments/report/latex_panel.hpp"

#include <algorithm>

#include "experiments/report/export_formats.hpp"
#include "experiments/report/text.hpp"

namespace croon::experiments {

namespace {

/// A name that is longer is broken into lines.
constexpr std::size_t kLongName = 22;

std::string unit_of(const Measure& measure) {
  return std::string(measure.unit) == "m" ? " (m)" : " ($^\\circ$)";
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

bool has_long_name(const ExportTable& table) {
  return std::any_of(table.variants.begin(), table.variants.end(),
                     [](const std::string& name) { return text_columns(name) > kLongName; });
}

std::string column_specification(const ExportTable& table, const Panel& panel) {
  std::string text =
      has_long_name(table) ? "@{}>{\\raggedright\\arraybackslash}p{0.16\\linewidth}" : "@{}l";
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

bool has_headings(const ExportTable& table) {
  return table.variants.size() > 1 && table.sensors.size() > 1;
}

bool begins_sensor(const ExportTable& table, std::size_t row) {
  return row == 0 || table.rows[row].sensor != table.rows[row - 1].sensor;
}

/// The line that names the sensor of the rows below.
std::string heading(const ExportTable& table, const Panel& panel, std::size_t row) {
  std::size_t columns = 1;
  for (const Group& group : panel) columns += width(table, group);
  return "\\multicolumn{" + std::to_string(columns) + "}{@{}l}{\\itshape " +
         sensor_name(table.rows[row]) + (begins_sensor(table, row) ? "" : ", continued") +
         "} \\\\\n";
}

std::string row_name(const ExportTable& table, const ExportRow& row) {
  if (!names_variants(table)) return sensor_name(row);
  return has_long_name(table) ? latex_breakable(row.variant) : latex_escaped(row.variant);
}

}  // namespace

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

std::size_t lines_of(const ExportTable& table, std::size_t row) {
  const bool has_heading = has_headings(table) && begins_sensor(table, row);
  const std::size_t name =
      names_variants(table) ? text_columns(table.rows[row].variant) / kLongName : 0;
  return 1 + name + (has_heading ? 1 : 0);
}

std::string latex_panel(const ExportTable& table, const Panel& panel, const RowRange& rows) {
  std::string text =
      "\\begin{tabular}{" + column_specification(table, panel) + "}\n" + panel_header(table, panel);
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    if (has_headings(table) && (i == rows.begin || begins_sensor(table, i))) {
      text += (i > rows.begin ? "\\addlinespace\n" : "") + heading(table, panel, i);
    }
    text += row_name(table, table.rows[i]) + panel_row(table, panel, table.rows[i]);
  }
  return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace croon::experiments

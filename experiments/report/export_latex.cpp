#include <array>
#include <string_view>

#include "experiments/report/export.hpp"
#include "experiments/report/renderers.hpp"

namespace croon::experiments {

namespace {

/// The two panels of an export, one above the other, because a page is too narrow for all columns.
std::array<View, 2> panels_of(const ExportTable& table) {
  const bool has_several = table.variants.size() > 1;
  View names{{{has_several || table.sensors.size() == 1 ? "variant" : "sensor"}}};
  if (has_several && table.sensors.size() > 1) names.heading = "sensor";
  View success = names;
  View dofs = names;
  const std::string group = "success (\\%)";
  success.columns.push_back({"rate", "<success_percent>", false, group});
  success.columns.push_back(
      {"95\\,\\% interval", "<success_low_percent>\\,--\\,<success_high_percent>", false, group});
  const auto with_unit = [](const Measure& measure) {
    return measure.name + std::string(measure.unit == std::string("m") ? " (m)" : " ($^\\circ$)");
  };
  for (const std::size_t k : {kRotation, kTranslation}) {
    for (const char* statistic : {"median", "p95"}) {
      success.columns.push_back({statistic,
                                 content_of(kMeasures[k], std::string("<") + statistic + ">"),
                                 false, with_unit(kMeasures[k])});
    }
  }
  for (const std::size_t k : kPaperOrder) {
    dofs.columns.push_back({"mean $\\pm$ std",
                            content_of(kMeasures[k], "<mean>\\,${}\\pm{}$\\,<std>"), false,
                            with_unit(kMeasures[k])});
  }
  return {success, dofs};
}

/// The rows, as many together as a page holds.
std::vector<RowRange> split_into_floats(const Table& table, const View& view) {
  constexpr std::size_t kLinesPerFloat = 28;  // With two panels, their heads and a caption.
  std::vector<RowRange> floats = {{0, 0}};
  std::size_t lines = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    lines += latex_lines(table, view, row);
    if (lines > kLinesPerFloat && floats.back().end > floats.back().begin) {
      floats.push_back({row, row});
      lines = latex_lines(table, view, row);
    }
    floats.back().end = row + 1;
  }
  return floats;
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

std::string export_latex(const ExportTable& table) {
  const auto [success, dofs] = panels_of(table);
  std::string text =
      "% Wants in the preamble: \\usepackage{booktabs,etoolbox,siunitx}\n"
      "% siunitx 2 or 3. Spans both columns of a page that has two.\n";
  for (const RowRange& rows : split_into_floats(table.table, success)) {
    text +=
        "\\begin{table*}[tbp]\n"
        "\\centering\n"
        "\\scriptsize\n"
        "\\setlength{\\tabcolsep}{2.5pt}\n"
        "\\robustify\\bfseries\n"
        "\\sisetup{detect-weight=true}\n" +
        caption_of(table, rows) + latex_tabular(table.table, success, rows) + "\n\\medskip\n\n" +
        latex_tabular(table.table, dofs, rows) + "\\end{table*}\n";
  }
  return text;
}

}  // namespace croon::experiments

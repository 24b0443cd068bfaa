#include <string_view>

#include "experiments/report/export.hpp"
#include "experiments/report/export_choice.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/text.hpp"
#include "framework/table/renderers.hpp"

namespace croon::experiments {

namespace {

/// The two panels of an export, one below the other, because all columns do not fit the page width.
std::vector<View> panels_of(const ExportTable& table) {
  const bool has_several = table.variants.size() > 1;
  View success{{{has_several || table.sensors.size() == 1 ? "variant" : "sensor"}}};
  if (!table.parts.empty() || (has_several && table.sensors.size() > 1)) {
    success.heading = "heading";
  }
  View dofs = success;
  const auto add = [](View& view, std::size_t k, const char* title, const char* content) {
    const Measure& measure = kMeasures[k];
    const std::string unit = measure.unit == std::string("m") ? " (m)" : " ($^\\circ$)";
    view.columns.push_back({title, content_of(measure, content), false, measure.name + unit});
  };
  for (const std::string& share : share_names(table.table)) {
    const std::string group = share + " (\\%)";
    success.columns.push_back({"rate", "<" + share + "_percent>", false, group});
    success.columns.push_back({"95\\,\\% interval",
                               "<" + share + "_low_percent>\\,to\\,<" + share + "_high_percent>",
                               false, group});
  }
  for (const std::size_t k : kDistances) {
    add(success, k, "median", "<median>");
    add(success, k, "p95", "<p95>");
    if (!table.base.empty()) add(success, k, "paired", "<paired_low>\\,to\\,<paired_high>");
  }
  for (const std::size_t k : kPaperOrder) {
    add(dofs, k, "mean $\\pm$ std", "<mean>\\,${}\\pm{}$\\,<std>");
  }
  return {in_unit_of(table, success), in_unit_of(table, dofs)};
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
std::string caption_of(const ExportTable& table, bool is_first) {
  if (!is_first) {
    return "\\addtocounter{table}{-1}\n\\caption{" + latex_escaped(table.caption.name) +
           ", continued.}\n";
  }
  std::string text;
  std::string name = table.caption.name;
  for (std::size_t i = 1; i < table.parts.size(); ++i) name += "-" + table.parts[i].caption.name;
  for (const std::string& sentence : caption_sentences(table)) {
    text += (text.empty() ? "" : "\n  ") + latex_escaped(sentence);
  }
  return "\\caption{" + text + "}\n\\label{" + label(table.caption.name) + "}\n";
}

}  // namespace

std::string export_latex(const ExportTable& table) {
  std::vector<View> panels;
  if (table.chosen.empty()) {
    panels = panels_of(table);
  } else {
    panels = {chosen_view(table, true)};
    refuse_too_wide(table, panels.front());
  }
  std::string text = "% Requires in the preamble: \\usepackage{booktabs,etoolbox,siunitx}\n";
  text += table.is_one_column ? "% siunitx 2 or 3. For one column of a two-column page.\n"
                              : "% siunitx 2 or 3. Spans both columns of a two-column page.\n";
  const std::string environment = table.is_one_column ? "table" : "table*";
  const double name_share = table.chosen.empty() ? 0.16 : kNameShare;
  bool is_first = true;
  for (const std::string& page : latex_pages(with_heading(table), panels, name_share)) {
    text += "\\begin{" + environment +
            "}[tbp]\n"
            "\\centering\n"
            "\\scriptsize\n"
            "\\setlength{\\tabcolsep}{2.5pt}\n"
            "\\robustify\\bfseries\n"
            "\\sisetup{detect-weight=true,group-minimum-digits=9}\n"
            "\\setlength{\\belowcaptionskip}{4pt}\n" +
            caption_of(table, is_first) + page + "\\end{" + environment + "}\n";
    is_first = false;
  }
  return text;
}

}  // namespace croon::experiments

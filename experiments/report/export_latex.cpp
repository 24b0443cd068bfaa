#include <string_view>

#include "experiments/report/export_formats.hpp"
#include "experiments/report/latex_panel.hpp"

namespace croon::experiments {

namespace {

/// Lines of rows that two panels, their heads and a caption leave room for on a page.
constexpr std::size_t kLinesPerFloat = 28;

/// The rows, as many together as a page holds.
std::vector<RowRange> split_into_floats(const ExportTable& table) {
  std::vector<RowRange> floats = {{0, 0}};
  std::size_t lines = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    lines += lines_of(table, row);
    if (lines > kLinesPerFloat && floats.back().end > floats.back().begin) {
      floats.push_back({row, row});
      lines = lines_of(table, row);
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

std::string caption_text(const ExportTable& table) {
  std::string text;
  for (const std::string& sentence : caption_sentences(table)) {
    text += (text.empty() ? "" : "\n  ") + latex_escaped(sentence);
  }
  return text;
}

/// The first has the caption and the label; others have its number.
std::string float_text(const ExportTable& table, const RowRange& rows) {
  const std::string caption =
      rows.begin == 0
          ? "\\caption{" + caption_text(table) + "}\n\\label{" + label(table.caption.name) + "}\n"
          : "\\addtocounter{table}{-1}\n\\caption{" + latex_escaped(table.caption.name) +
                ", continued.}\n";
  return "\\begin{table*}[tbp]\n"
         "\\centering\n"
         "\\scriptsize\n"
         "\\setlength{\\tabcolsep}{2.5pt}\n"
         "\\robustify\\bfseries\n"
         "\\sisetup{detect-weight=true}\n" +
         caption + latex_panel(table, success_panel(), rows) + "\n\\medskip\n\n" +
         latex_panel(table, dof_panel(), rows) + "\\end{table*}\n";
}

}  // namespace

std::string export_latex(const ExportTable& table) {
  std::string text =
      "% Wants in the preamble: \\usepackage{booktabs,etoolbox,siunitx}\n"
      "% siunitx 2 or 3. Spans both columns of a page that has two.\n";
  for (const RowRange& rows : split_into_floats(table)) text += float_text(table, rows);
  return text;
}

}  // namespace croon::experiments

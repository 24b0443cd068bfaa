#include "experiments/report/figure_title.hpp"

#include <sstream>

#include "framework/base/text.hpp"

namespace croon::experiments {
namespace {

constexpr double kLine = 1.3;  // Line height, in multiples of the title's font size.

/// Breaks the text at spaces into lines of at most `columns` columns.
std::vector<std::string> wrapped(const std::string& text, std::size_t columns) {
  std::vector<std::string> lines = {""};
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    std::string& line = lines.back();
    if (line.empty()) {
      line = word;
    } else if (text_columns(line) + 1 + text_columns(word) <= columns) {
      line += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

}  // namespace

FigureTitle::FigureTitle(const std::string& title, const std::string& explanation,
                         const Sheet& sheet, double width)
    : sheet_(sheet) {
  if (!sheet.has_title) return;
  const auto columns = static_cast<std::size_t>(width / text_width("x", sheet.small()));
  title_ = wrapped(title, columns * 3 / 4);  // The title is larger or bold.
  explanation_ = wrapped(explanation, columns);
}

double FigureTitle::height() const {
  return kLine * sheet_.title() * static_cast<double>(title_.size() + explanation_.size());
}

void FigureTitle::draw(Drawing& drawing, double left, double top) const {
  double y = top + 0.9 * sheet_.title();
  for (const auto& [lines, style] : {std::pair(&title_, "title"), {&explanation_, "small"}}) {
    for (const std::string& line : *lines) {
      drawing.text(left, y, line, Anchor::start, style);
      y += kLine * sheet_.title();
    }
  }
}

}  // namespace croon::experiments

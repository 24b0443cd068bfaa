#pragma once

#include <string>
#include <vector>

#include "framework/picture/drawing.hpp"

namespace croon::experiments {

/// The title of a figure and the explanation below it, broken into lines that fit its width. Sheets
/// without titles show neither; both are then only in the description of the drawing.
class FigureTitle {
 public:
  FigureTitle(const std::string& title, const std::string& explanation, const Sheet& sheet,
              double width);

  /// The height of the lines; 0 if the sheet has no title.
  double height() const;

  /// Draws the lines from `top` downwards.
  void draw(Drawing& drawing, double left, double top) const;

 private:
  Sheet sheet_;
  std::vector<std::string> title_, explanation_;
};

}  // namespace croon::experiments

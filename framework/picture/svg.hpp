#pragma once

#include <array>
#include <string>
#include <vector>

namespace croon {

/// The part of a text that is at its position.
enum class Anchor { start, middle, end };

/// A picture under construction, in pixels, y down. `style` names classes of the style sheet.
class Svg {
 public:
  /// `style_sheet` is CSS.
  Svg(double width_px, double height_px, const std::string& style_sheet);

  void line(double x1, double y1, double x2, double y2, const std::string& style);
  void rectangle(double x, double y, double width, double height, const std::string& style);
  /// A closed area; its corners as x, y.
  void area(const std::vector<std::array<double, 2>>& corners, const std::string& style);
  void dot(double x, double y, double radius, const std::string& style);
  /// `text` may hold anything. `turn_deg` turns it about its position, clockwise.
  void text(double x, double y, const std::string& text, Anchor anchor, const std::string& style,
            double turn_deg = 0.0);
  /// The whole file.
  std::string bytes() const { return bytes_ + "</svg>\n"; }

 private:
  std::string bytes_;
};

}  // namespace croon

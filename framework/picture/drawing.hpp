#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "framework/picture/colour.hpp"

namespace croon {

/// The part of a text that is placed at its position.
enum class Anchor { start, middle, end };

/// The medium of a drawing. Lengths are in its units: pixels on a screen, points on paper.
struct Sheet {
  double width = 0.0;     ///< Of the whole drawing; 0: the width of its content.
  bool is_paper = false;  ///< Whether a unit is a point (1/72 inch) instead of a pixel (1/96 inch).
  bool has_title = true;

  double text() const { return is_paper ? 8.0 : 12.0; }   ///< The size of text.
  double small() const { return is_paper ? 8.0 : 11.0; }  ///< Of ticks and legends.
  double title() const { return is_paper ? 8.0 : 14.0; }
  double stroke() const { return is_paper ? 0.5 : 1.0; }  ///< The width of a thin line.
  double unit_pt() const { return is_paper ? 1.0 : 0.75; }
};

/// The column and the text width of a page with two columns: 88 mm and 180 mm.
inline constexpr double kPointsPerMm = 72.0 / 25.4;
inline constexpr double kOneColumn_mm = 88.0;
inline constexpr double kTwoColumns_mm = 180.0;
inline constexpr Sheet kOneColumn = {kOneColumn_mm * kPointsPerMm, true, false};
inline constexpr Sheet kTwoColumns = {kTwoColumns_mm * kPointsPerMm, true, false};

using Corner = std::array<double, 2>;

/// A drawing as a list of primitives in the units of its sheet, x to the right, y down. Every
/// writer (writers.hpp) draws the same primitives.
///
/// A style is one or more names of `look_of`, with spaces between them: "curve c1 d2".
class Drawing {
 public:
  struct Line {
    double x1, y1, x2, y2;
    std::string style;
  };
  struct Rectangle {
    double x, y, width, height;
    std::string style;
  };
  struct Area {
    std::vector<Corner> corners;
    std::string style;
  };
  struct Polyline {
    std::vector<Corner> corners;
    std::string style;
  };
  struct Dot {
    double x, y, radius;
    std::string style;
  };
  struct Text {
    double x, y;
    std::string text;
    Anchor anchor;
    std::string style;
    double turn_deg;
  };
  using Element = std::variant<Line, Rectangle, Area, Polyline, Dot, Text>;

  Drawing(double width, double height, const Sheet& sheet = {})
      : width_(width), height_(height), sheet_(sheet) {}

  void line(double x1, double y1, double x2, double y2, const std::string& style);
  void rectangle(double x, double y, double width, double height, const std::string& style);
  /// A closed area.
  void area(const std::vector<Corner>& corners, const std::string& style);
  /// Lines from corner to corner; dashes continue across corners.
  void polyline(const std::vector<Corner>& corners, const std::string& style);
  void dot(double x, double y, double radius, const std::string& style);
  /// Bytes of `text` that are not UTF-8 are replaced. `turn_deg` rotates it clockwise about its
  /// position.
  void text(double x, double y, const std::string& text, Anchor anchor, const std::string& style,
            double turn_deg = 0.0);

  /// Sets a description of the drawing, which is stored in its file.
  void describe(const std::string& text);

  double width() const { return width_; }
  double height() const { return height_; }
  const Sheet& sheet() const { return sheet_; }
  const std::string& description() const { return description_; }
  const std::vector<Element>& elements() const { return elements_; }

 private:
  double width_;
  double height_;
  Sheet sheet_;
  std::string description_;
  std::vector<Element> elements_;
};

/// The style of a primitive.
struct Look {
  bool has_stroke = false;
  bool has_fill = false;
  Colour stroke, fill;
  double fill_opacity = 1.0;
  double width = 1.0;          ///< Of the stroke.
  std::vector<double> dashes;  ///< Alternating lengths of dashes and gaps; empty: a solid line.
  double text_size = 0.0;
  bool is_bold = false;
};

/// The look of a style. Names: c0 to c7 and s0 to s7 are colours (of series and of sensors), d0 to
/// d4 are dashes, the others are parts of a chart: page, grid, zero, box, inside (of a box whose
/// outline is open), line, median, band, edge (of a band), curve, dot, marker, bar (of a scale),
/// and for text title, small, name, sensor. Throws std::logic_error for another name.
Look look_of(const std::string& style, const Sheet& sheet);

/// The same looks as CSS classes, with colours for dark pages beside those for light ones. The
/// names of the classes begin with `prefix`.
std::string style_sheet(const Sheet& sheet, const std::string& prefix = "");

/// The numbers of colours, dashes and markers before they repeat.
inline constexpr std::size_t kSeriesColours = 8;
inline constexpr std::size_t kSeriesDashes = 5;
inline constexpr std::size_t kSeriesMarkers = 7;

/// The maximum width of text in common sans-serif fonts.
double text_width(const std::string& text, double size);

}  // namespace croon

#include <cmath>
#include <sstream>
#include <utility>

#include "framework/base/text.hpp"
#include "framework/picture/writers.hpp"

namespace croon {

namespace {

const char* anchor_name(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

/// Writes each primitive as an element.
class SvgWriter {
 public:
  SvgWriter(const Sheet& sheet, std::string prefix)
      : digit_(sheet.is_paper ? 100.0 : 10.0), prefix_(std::move(prefix)) {}

  std::string operator()(const Drawing::Line& line) const {
    return "<line" + attribute("x1", line.x1) + attribute("y1", line.y1) +
           attribute("x2", line.x2) + attribute("y2", line.y2) + styled(line.style) + "/>\n";
  }

  std::string operator()(const Drawing::Rectangle& box) const {
    return "<rect" + attribute("x", box.x) + attribute("y", box.y) + attribute("width", box.width) +
           attribute("height", box.height) + styled(box.style) + "/>\n";
  }

  std::string operator()(const Drawing::Area& area) const {
    return "<polygon points=\"" + points(area.corners) + "\"" + styled(area.style) + "/>\n";
  }

  std::string operator()(const Drawing::Polyline& line) const {
    return "<polyline points=\"" + points(line.corners) + "\"" + styled(line.style) + "/>\n";
  }

  std::string operator()(const Drawing::Dot& dot) const {
    return "<circle" + attribute("cx", dot.x) + attribute("cy", dot.y) +
           attribute("r", dot.radius) + styled(dot.style) + "/>\n";
  }

  std::string operator()(const Drawing::Text& text) const {
    std::string bytes = "<text" + attribute("x", text.x) + attribute("y", text.y) +
                        " text-anchor=\"" + anchor_name(text.anchor) + "\"" + styled(text.style);
    if (text.turn_deg != 0.0) {
      bytes += " transform=\"rotate(" + shortest_number(text.turn_deg) + " " + number(text.x) +
               " " + number(text.y) + ")\"";
    }
    return bytes + ">" + markup_escaped(text.text) + "</text>\n";
  }

 private:
  /// A tenth of a pixel or a hundredth of a point is the visible precision.
  std::string number(double value) const {
    return shortest_number(std::round(value * digit_) / digit_);
  }

  /// The names of `style` as classes, each with the prefix.
  std::string styled(const std::string& style) const {
    std::string classes;
    std::istringstream names(style);
    for (std::string name; names >> name;) classes += (classes.empty() ? "" : " ") + prefix_ + name;
    return " class=\"" + classes + "\"";
  }

  /// ` name="value"`.
  std::string attribute(const char* name, double value) const {
    return std::string(" ") + name + "=\"" + number(value) + "\"";
  }

  std::string points(const std::vector<Corner>& corners) const {
    std::string text;
    for (const auto& [x, y] : corners) text += number(x) + "," + number(y) + " ";
    return text;
  }

  double digit_;
  std::string prefix_;
};

/// The elements of an SVG file: `before` them, its style sheet.
std::string svg(const Drawing& drawing, const std::string& before, const std::string& prefix) {
  const std::string unit = drawing.sheet().is_paper ? "pt" : "";
  const std::string width = shortest_number(std::round(100.0 * drawing.width()) / 100.0);
  const std::string height = shortest_number(std::round(100.0 * drawing.height()) / 100.0);
  const std::string desc = drawing.description().empty()
                               ? ""
                               : "<desc>" + markup_escaped(drawing.description()) + "</desc>\n";
  std::string bytes = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + unit +
                      "\" height=\"" + height + unit + "\" viewBox=\"0 0 " + width + " " + height +
                      "\">\n" + desc + before;
  const SvgWriter writer(drawing.sheet(), prefix);
  for (const Drawing::Element& element : drawing.elements()) bytes += std::visit(writer, element);
  return bytes + "</svg>\n";
}

/// The prefix of classes in a page, which has classes of its own.
constexpr const char* kInlinePrefix = "chart-";

}  // namespace

std::string svg_bytes(const Drawing& drawing) {
  return svg(drawing, "<style>\n" + style_sheet(drawing.sheet()) + "</style>\n", "");
}

std::string inline_svg(const Drawing& drawing) { return svg(drawing, "", kInlinePrefix); }

std::string inline_style_sheet() { return style_sheet({}, kInlinePrefix); }

const std::vector<DrawingFormat>& drawing_formats() {
  static const std::vector<DrawingFormat> formats = {{"pdf", pdf_bytes}, {"svg", svg_bytes}};
  return formats;
}

}  // namespace croon

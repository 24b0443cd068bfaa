#include <cmath>

#include "framework/base/text.hpp"
#include "framework/picture/writers.hpp"

namespace croon {
namespace {

/// Writes each primitive as commands of pgf, y up, in points of 1/72 inch ("bp" in TeX).
class PgfWriter {
 public:
  explicit PgfWriter(const Drawing& drawing)
      : sheet_(drawing.sheet()), height_(drawing.height()), unit_(drawing.sheet().unit_pt()) {}

  std::string length(double value) const {
    return shortest_number(std::round(100.0 * value * unit_) / 100.0) + "bp";
  }

  std::string operator()(const Drawing::Line& line) const {
    return painted(line.style, path({{line.x1, line.y1}, {line.x2, line.y2}}));
  }

  std::string operator()(const Drawing::Rectangle& box) const {
    return painted(box.style, "\\pgfpathrectangle{" + point(box.x, box.y + box.height) + "}{" +
                                  "\\pgfqpoint{" + length(box.width) + "}{" + length(box.height) +
                                  "}}");
  }

  std::string operator()(const Drawing::Area& area) const {
    return painted(area.style, path(area.corners) + "\\pgfpathclose");
  }

  std::string operator()(const Drawing::Polyline& line) const {
    return painted(line.style, path(line.corners));
  }

  std::string operator()(const Drawing::Dot& dot) const {
    return painted(dot.style,
                   "\\pgfpathcircle{" + point(dot.x, dot.y) + "}{" + length(dot.radius) + "}");
  }

  std::string operator()(const Drawing::Text& text) const {
    const Look look = look_of(text.style, sheet_);
    const char* side = text.anchor == Anchor::start ? "left,"
                       : text.anchor == Anchor::end ? "right,"
                                                    : "";
    const double size = look.text_size * unit_;
    std::string options = std::string(side) + "base,at={" + point(text.x, text.y) + "}";
    if (text.turn_deg != 0.0) options += ",rotate=" + shortest_number(-text.turn_deg);
    return "\\begin{pgfscope}" + colour("text", look.fill) + "\\pgftext[" + options +
           "]{\\color{croon-text}\\fontsize{" + shortest_number(size) + "}{" +
           shortest_number(1.2 * size) + "}\\selectfont " + (look.is_bold ? "\\bfseries " : "") +
           latex_escaped(text.text) + "}\\end{pgfscope}\n";
  }

 private:
  std::string point(double x, double y) const {
    return "\\pgfqpoint{" + length(x) + "}{" + length(height_ - y) + "}";
  }

  std::string path(const std::vector<Corner>& corners) const {
    std::string text;
    for (const auto& [x, y] : corners) {
      text += (text.empty() ? "\\pgfpathmoveto{" : "\\pgfpathlineto{") + point(x, y) + "}";
    }
    return text;
  }

  /// The definition of the colour croon-`name`.
  static std::string colour(const char* name, const Colour& colour) {
    return std::string("\\definecolor{croon-") + name + "}{RGB}{" + std::to_string(colour.red) +
           "," + std::to_string(colour.green) + "," + std::to_string(colour.blue) + "}";
  }

  std::string painted(const std::string& style, const std::string& path) const {
    const Look look = look_of(style, sheet_);
    if (path.empty() || (!look.has_stroke && !look.has_fill)) return "";
    std::string text = "\\begin{pgfscope}";
    std::string paint;
    if (look.has_fill) {
      text += colour("fill", look.fill) + "\\pgfsetfillcolor{croon-fill}";
      if (look.fill_opacity < 1.0) {
        text += "\\pgfsetfillopacity{" + shortest_number(look.fill_opacity) + "}";
      }
      paint = "fill";
    }
    if (look.has_stroke) {
      text += colour("stroke", look.stroke) +
              "\\pgfsetstrokecolor{croon-stroke}\\pgfsetlinewidth{" + length(look.width) + "}";
      if (!look.dashes.empty()) text += dashes(look.dashes);
      paint += paint.empty() ? "stroke" : ",stroke";
    }
    return text + path + "\\pgfusepath{" + paint + "}\\end{pgfscope}\n";
  }

  std::string dashes(const std::vector<double>& lengths) const {
    std::string text;
    for (const double one : lengths) text += "{" + length(one) + "}";
    return "\\pgfsetdash{" + text + "}{0pt}";
  }

  Sheet sheet_;
  double height_;
  double unit_;
};

}  // namespace

std::string pgf_bytes(const Drawing& drawing) {
  const PgfWriter writer(drawing);
  std::string comment;
  for (const char c : drawing.description()) comment += c == '\n' || c == '\r' ? ' ' : c;
  std::string bytes = "% " + comment +
                      "\n% Requires in the preamble: "
                      "\\usepackage{pgf}\n\\begingroup\n\\begin{pgfpicture}\n\\pgfpathrectangle{"
                      "\\pgfpointorigin}{\\pgfqpoint{" +
                      writer.length(drawing.width()) + "}{" + writer.length(drawing.height()) +
                      "}}\n\\pgfusepath{use as bounding box}\n";
  for (const Drawing::Element& element : drawing.elements()) bytes += std::visit(writer, element);
  return bytes + "\\end{pgfpicture}%\n\\endgroup\n";
}

}  // namespace croon

#include "framework/picture/svg.hpp"

#include <cmath>

#include "framework/base/text.hpp"

namespace croon {

namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20U ? ' ' : c;
    }
  }
  return result;
}

/// A tenth of a pixel is all that can be seen.
std::string pixels(double value) { return shortest_number(std::round(value * 10.0) / 10.0); }

/// ` name="value"`.
std::string attribute(const char* name, double value) {
  return std::string(" ") + name + "=\"" + pixels(value) + "\"";
}

std::string styled(const std::string& style) { return " class=\"" + style + "\""; }

const char* anchor_name(Anchor anchor) {
  return anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
}

}  // namespace

Svg::Svg(double width_px, double height_px, const std::string& style_sheet) {
  bytes_ = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", width_px) +
           attribute("height", height_px) + " viewBox=\"0 0 " + shortest_number(width_px) + " " +
           shortest_number(height_px) + "\">\n<style>\n" + style_sheet + "</style>\n";
}

void Svg::line(double x1, double y1, double x2, double y2, const std::string& style) {
  bytes_ += "<line" + attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) +
            attribute("y2", y2) + styled(style) + "/>\n";
}

void Svg::rectangle(double x, double y, double width, double height, const std::string& style) {
  bytes_ += "<rect" + attribute("x", x) + attribute("y", y) + attribute("width", width) +
            attribute("height", height) + styled(style) + "/>\n";
}

void Svg::area(const std::vector<std::array<double, 2>>& corners, const std::string& style) {
  bytes_ += "<polygon points=\"";
  for (const auto& [x, y] : corners) bytes_ += pixels(x) + "," + pixels(y) + " ";
  bytes_ += "\"" + styled(style) + "/>\n";
}

void Svg::dot(double x, double y, double radius, const std::string& style) {
  bytes_ += "<circle" + attribute("cx", x) + attribute("cy", y) + attribute("r", radius) +
            styled(style) + "/>\n";
}

void Svg::text(double x, double y, const std::string& text, Anchor anchor, const std::string& style,
               double turn_deg) {
  bytes_ += "<text" + attribute("x", x) + attribute("y", y) + " text-anchor=\"" +
            anchor_name(anchor) + "\"" + styled(style);
  if (turn_deg != 0.0) {
    bytes_ += " transform=\"rotate(" + shortest_number(turn_deg) + " " + shortest_number(x) + " " +
              shortest_number(y) + ")\"";
  }
  bytes_ += ">" + escaped(text) + "</text>\n";
}

}  // namespace croon

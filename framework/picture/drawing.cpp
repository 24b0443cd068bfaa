#include "framework/picture/drawing.hpp"

#include <array>
#include <sstream>
#include <stdexcept>

#include "framework/base/text.hpp"

namespace croon {
namespace {

/// The style of a part of a chart. Colours are hexadecimal; nullptr: the colour of the series,
/// "none": not drawn. Widths are multiples of a thin line.
struct Part {
  const char* name;
  const char* stroke;
  const char* fill;
  double width = 1.0;
  double fill_opacity = 1.0;
  const char* dark_stroke = nullptr;  ///< On a dark page, if it differs.
  const char* dark_fill = nullptr;
};

constexpr Part kParts[] = {
    {"page", "none", "ffffff", 1.0, 1.0, nullptr, "16181c"},
    {"grid", "e2e2e2", "none", 1.0, 1.0, "33373d"},
    {"zero", "888888", "none", 1.0, 1.0, "8a8f98"},
    {"box", nullptr, nullptr, 1.2, 0.35},
    {"line", nullptr, "none", 1.2},
    {"median", nullptr, "none", 2.4},
    {"inside", "none", nullptr, 1.0, 0.35},
    {"band", "none", nullptr, 1.0, 0.15},
    {"edge", nullptr, "none", 0.8},
    {"curve", nullptr, "none", 2.0},
    {"dot", "none", nullptr, 1.0, 0.6},
    {"marker", "none", nullptr},
    {"bar", "none", "222222", 1.0, 1.0, nullptr, "dddddd"},
};

/// A kind of text.
struct TextPart {
  const char* name;
  double (Sheet::*size)() const;
  bool is_bold;
  const char* colour;
  const char* dark;
};

constexpr TextPart kTextParts[] = {{"name", &Sheet::text, false, "222222", "dddddd"},
                                   {"sensor", &Sheet::text, false, "222222", "dddddd"},
                                   {"title", &Sheet::title, true, "222222", "dddddd"},
                                   {"small", &Sheet::small, false, "555555", "aaaaaa"}};

/// The colour of all text on paper.
constexpr const char* kInk = "000000";

/// Colours that colour-blind readers can distinguish (Okabe and Ito 2008, two of them replaced),
/// visible on white and on black.
constexpr std::array<const char*, kSeriesColours> kColours = {
    "0072b2", "d55e00", "009e73", "cc79a7", "e69f00", "56b4e9", "8c7a00", "808080"};
constexpr const char* kDarkFirstColour = "4aa8e0";

/// Lengths as multiples of a thin line.
const std::array<std::vector<double>, kSeriesDashes> kDashes = {
    {{}, {8, 4}, {2.5, 3}, {9, 3, 2.5, 3}, {14, 4, 4, 4}}};

Colour colour_of(const std::string& hex) {
  const auto byte = [&](std::size_t at) {
    return static_cast<std::uint8_t>(std::stoi(hex.substr(at, 2), nullptr, 16));
  };
  return {byte(0), byte(2), byte(4)};
}

/// Sets `colour` unless `hex` is null, which means the colour of the series.
void set_colour(const char* hex, bool& is_drawn, Colour& colour) {
  if (hex == nullptr) return;
  is_drawn = std::string("none") != hex;
  if (is_drawn) colour = colour_of(hex);
}

/// Adds the part `name` of a style to `look`.
void add_to(Look& look, const std::string& name, const Sheet& sheet) {
  for (const Part& part : kParts) {
    if (name != part.name) continue;
    set_colour(part.stroke, look.has_stroke, look.stroke);
    set_colour(part.fill, look.has_fill, look.fill);
    look.width = part.width * sheet.stroke();
    look.fill_opacity = part.fill_opacity;
    return;
  }
  for (const TextPart& part : kTextParts) {
    if (name != part.name) continue;
    set_colour(sheet.is_paper ? kInk : part.colour, look.has_fill, look.fill);
    look.text_size = (sheet.*part.size)();
    look.is_bold = part.is_bold;
    return;
  }
  throw std::logic_error("unknown look \"" + name + "\"");
}

/// Sets the colour ("c1", "s1") or dashes ("d1") of a series in `look`. Returns false for any other
/// `name`.
bool add_series(Look& look, const std::string& name, const Sheet& sheet) {
  if (name.size() != 2 || name[1] < '0' || name[1] > '9') return false;
  const auto index = static_cast<std::size_t>(name[1] - '0');
  if (name[0] == 'd') {
    for (const double length : kDashes.at(index)) look.dashes.push_back(length * sheet.stroke());
    return true;
  }
  if (name[0] != 'c' && name[0] != 's') return false;
  look.has_stroke = look.has_fill = true;
  look.stroke = look.fill = name[0] == 'c' ? colour_of(kColours.at(index)) : sensor_colour(index);
  return true;
}

std::string css_colour(const char* property, const char* hex) {
  if (hex == nullptr) return "";
  const std::string colour = std::string("none") == hex ? hex : hex_text(colour_of(hex));
  return " " + std::string(property) + ": " + colour + ";";
}

std::string css_of(const Part& part, const Sheet& sheet, const std::string& dot) {
  std::string text =
      dot + part.name + " {" + css_colour("stroke", part.stroke) + css_colour("fill", part.fill);
  if (part.fill_opacity < 1.0) text += " fill-opacity: " + shortest_number(part.fill_opacity) + ";";
  const bool has_stroke = part.stroke == nullptr || std::string("none") != part.stroke;
  if (has_stroke) text += " stroke-width: " + shortest_number(part.width * sheet.stroke()) + ";";
  return text + " }\n";
}

std::string css_of_series(const Sheet& sheet, const std::string& dot) {
  std::string text;
  const auto add = [&](const std::string& name) {
    Look look;
    add_series(look, name, sheet);
    const std::string hex = hex_text(look.fill);
    text += dot + name + " { stroke: " + hex + "; fill: " + hex + "; }\n";
  };
  for (std::size_t i = 0; i < kSeriesColours; ++i) add("c" + std::to_string(i));
  for (std::size_t i = 0; i < kSeriesColours; ++i) add("s" + std::to_string(i));
  for (std::size_t i = 1; i < kSeriesDashes; ++i) {
    text += dot + "d" + std::to_string(i) + " { stroke-dasharray:";
    for (const double length : kDashes[i]) text += " " + shortest_number(length * sheet.stroke());
    text += "; }\n";
  }
  return text;
}

std::string css_of_dark_pages(const std::string& dot) {
  std::string text = "@media screen and (prefers-color-scheme: dark) {\n";
  text +=
      "  " + dot + "c0 { stroke: #" + kDarkFirstColour + "; fill: #" + kDarkFirstColour + "; }\n";
  for (const TextPart& part : kTextParts) {
    text += "  " + dot + part.name + " { fill: #" + part.dark + "; }\n";
  }
  for (const Part& part : kParts) {
    text += "  " + dot + part.name + " {" +
            css_colour("stroke", part.dark_stroke == nullptr ? part.stroke : part.dark_stroke) +
            css_colour("fill", part.dark_fill == nullptr ? part.fill : part.dark_fill) + " }\n";
  }
  return text + "}\n";
}

}  // namespace

void Drawing::line(double x1, double y1, double x2, double y2, const std::string& style) {
  elements_.emplace_back(Line{x1, y1, x2, y2, style});
}

void Drawing::rectangle(double x, double y, double width, double height, const std::string& style) {
  elements_.emplace_back(Rectangle{x, y, width, height, style});
}

void Drawing::area(const std::vector<Corner>& corners, const std::string& style) {
  elements_.emplace_back(Area{corners, style});
}

void Drawing::polyline(const std::vector<Corner>& corners, const std::string& style) {
  elements_.emplace_back(Polyline{corners, style});
}

void Drawing::dot(double x, double y, double radius, const std::string& style) {
  elements_.emplace_back(Dot{x, y, radius, style});
}

void Drawing::text(double x, double y, const std::string& text, Anchor anchor,
                   const std::string& style, double turn_deg) {
  elements_.emplace_back(Text{x, y, valid_utf8(text), anchor, style, turn_deg});
}

void Drawing::describe(const std::string& text) { description_ = valid_utf8(text); }

Look look_of(const std::string& style, const Sheet& sheet) {
  // Series first, because a part may override the style of a series.
  std::vector<std::string> parts;
  Look look;
  std::istringstream names(style);
  for (std::string name; names >> name;) {
    if (!add_series(look, name, sheet)) parts.push_back(name);
  }
  for (const std::string& part : parts) add_to(look, part, sheet);
  return look;
}

std::string style_sheet(const Sheet& sheet, const std::string& prefix) {
  const std::string dot = "." + prefix;
  std::string text = css_of_series(sheet, dot);
  for (const TextPart& part : kTextParts) {
    text += dot + part.name + " { font: " + (part.is_bold ? "bold " : "") +
            shortest_number((sheet.*part.size)()) + "px sans-serif; fill: #" +
            (sheet.is_paper ? kInk : part.colour) + "; }\n";
  }
  for (const Part& part : kParts) text += css_of(part, sheet, dot);
  // Paper is white.
  return sheet.is_paper ? text : text + css_of_dark_pages(dot);
}

double text_width(const std::string& text, double size) {
  // Relative to the size; the letters of DejaVu Sans are among the widest.
  constexpr double kColumn = 0.6;
  return kColumn * size * static_cast<double>(text_columns(text));
}

}  // namespace croon

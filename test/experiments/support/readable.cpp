#include "test/experiments/support/readable.hpp"

#include <Eigen/Geometry>

namespace croon::test {
namespace {

using Box = Eigen::AlignedBox2d;
using Eigen::Vector2d;

Box box_of(const std::vector<Corner>& corners) {
  Box box;
  for (const auto& [x, y] : corners) box.extend(Vector2d(x, y));
  return box;
}

/// The letters of a text, which are narrower than text_width() on average.
Box box_of(const Drawing::Text& text, const Sheet& sheet) {
  const double size = look_of(text.style, sheet).text_size;
  const double width = 0.83 * text_width(text.text, size);
  const double height = 0.7 * size;
  const double before = text.anchor == Anchor::start    ? 0.0
                        : text.anchor == Anchor::middle ? width / 2.0
                                                        : width;
  const double from = -before, to = width - before;
  if (text.turn_deg == 0.0) {
    return box_of({{text.x + from, text.y - height}, {text.x + to, text.y}});
  }
  return box_of({{text.x - height, text.y - to}, {text.x, text.y - from}});  // Upwards.
}

/// The centres and corners of a mark.
Box box_of(const Drawing::Element& element, const Sheet& sheet) {
  if (const auto* line = std::get_if<Drawing::Line>(&element)) {
    return box_of({{line->x1, line->y1}, {line->x2, line->y2}});
  }
  if (const auto* one = std::get_if<Drawing::Rectangle>(&element)) {
    return box_of({{one->x, one->y}, {one->x + one->width, one->y + one->height}});
  }
  if (const auto* area = std::get_if<Drawing::Area>(&element)) return box_of(area->corners);
  if (const auto* curve = std::get_if<Drawing::Polyline>(&element)) return box_of(curve->corners);
  if (const auto* dot = std::get_if<Drawing::Dot>(&element)) return box_of({{dot->x, dot->y}});
  return box_of(std::get<Drawing::Text>(element), sheet);
}

}  // namespace

std::vector<std::string> unreadable_parts(const Drawing& drawing) {
  constexpr double kTolerance = 1.0;
  const Vector2d tolerance = Vector2d::Constant(kTolerance);
  const Box page(-tolerance, Vector2d(drawing.width(), drawing.height()) + tolerance);
  std::vector<std::string> faults;
  std::vector<std::pair<Box, std::string>> texts;
  for (const Drawing::Element& element : drawing.elements()) {
    const Box box = box_of(element, drawing.sheet());
    const auto* text = std::get_if<Drawing::Text>(&element);
    const std::string name = text == nullptr ? "a mark" : '"' + text->text + '"';
    if (!page.contains(box)) faults.push_back(name + " is beyond the page");
    if (text == nullptr) continue;
    for (const auto& [other, other_name] : texts) {
      const Box common = box.intersection(other);
      if ((common.sizes().array() > kTolerance).all()) {
        faults.push_back(name + " is on top of " + other_name);
      }
    }
    texts.emplace_back(box, name);
  }
  return faults;
}

}  // namespace croon::test

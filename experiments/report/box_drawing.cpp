#include "experiments/report/box_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace croon::experiments {
namespace {

constexpr double kFullDotPitch = 22.0;  ///< Dots have their full size from this pitch on.

bool is_inside(double value, const Interval& axis) {
  return value >= axis.low && value <= axis.high;
}

/// Draws an arrowhead at the end of the axis, with the number `count` of values beyond it.
void draw_beyond(Drawing& drawing, double x, double pitch, double border, std::size_t count,
                 bool is_up, std::size_t series) {
  if (count == 0) return;
  const double text = drawing.sheet().small();
  const double side = is_up ? -1.0 : 1.0;
  draw_arrowhead(drawing, x, border + side * 0.4 * text, 0.3 * text, is_up,
                 "marker c" + std::to_string(series % kSeriesColours));
  const std::string number = std::to_string(count);
  if (text_width(number, text) <= pitch) {
    drawing.text(x, border + (is_up ? -0.9 : 1.6) * text, number, Anchor::middle, "small");
  } else {
    drawing.text(x + 0.36 * text, border + side * 0.9 * text, number,
                 is_up ? Anchor::start : Anchor::end, "small", -90.0);
  }
}

/// Draws the box of the quartiles, without the sides beyond the axis.
void draw_quartiles(Drawing& drawing, const Plot& plot, double left, double width,
                    const BoxPlot& box, const std::string& style) {
  const double top = plot.y_inside(box.upper_quartile);
  const double bottom = plot.y_inside(box.lower_quartile);
  const bool has_top = is_inside(box.upper_quartile, plot.y_range);
  const bool has_bottom = is_inside(box.lower_quartile, plot.y_range);
  if (has_top && has_bottom) {
    return drawing.rectangle(left, top, width, bottom - top, "box" + style);
  }
  if (bottom <= top) return;  // Entirely beyond the axis.
  const double right = left + width;
  drawing.rectangle(left, top, width, bottom - top, "inside" + style);
  if (!has_top && !has_bottom) {
    drawing.line(left, top, left, bottom, "line" + style);
    drawing.line(right, top, right, bottom, "line" + style);
    return;
  }
  const double open = has_top ? bottom : top;
  const double closed = has_top ? top : bottom;
  drawing.polyline({{left, open}, {left, closed}, {right, closed}, {right, open}}, "line" + style);
}

/// Draws the whiskers; a whisker that extends beyond the axis has no cap.
void draw_whiskers(Drawing& drawing, const Plot& plot, double x, double width, const BoxPlot& box,
                   const std::string& style) {
  for (const auto& [quartile, whisker] : {std::pair(box.lower_quartile, box.lower_whisker),
                                          std::pair(box.upper_quartile, box.upper_whisker)}) {
    const double from = plot.y_inside(quartile);
    const double to = plot.y_inside(whisker);
    if (from != to) drawing.line(x, from, x, to, "line" + style);
    if (!is_inside(whisker, plot.y_range)) continue;
    drawing.line(x - 0.3 * width, to, x + 0.3 * width, to, "line" + style);
  }
}

/// Draws values as dots, indistinguishable dots only once: otherwise the file of a long run would
/// have many megabytes.
void draw_dots(Drawing& drawing, const Plot& plot, double x, double pitch,
               const std::vector<double>& values, const std::string& style) {
  std::set<double> rows;
  for (const double value : values) {
    if (is_inside(value, plot.y_range)) rows.insert(std::round(2.0 * plot.y(value)) / 2.0);
  }
  for (const double y : rows) {
    drawing.dot(x, y, 1.8 * std::min(1.0, pitch / kFullDotPitch + 0.2), "dot" + style);
  }
}

}  // namespace

Beyond count_beyond(const std::vector<double>& values, const Interval& axis) {
  Beyond beyond;
  for (const double value : values) {
    beyond.above += value > axis.high;
    beyond.below += value < axis.low;
  }
  return beyond;
}

bool is_cut(const std::vector<double>& values, const Interval& axis) {
  if (values.size() < kMinBoxValues) return false;
  const BoxPlot box = box_plot(values);
  return !is_inside(box.lower_whisker, axis) || !is_inside(box.upper_whisker, axis);
}

double beyond_height(const Sheet& sheet, double pitch, std::size_t count) {
  if (count == 0) return 0.0;
  const double text = sheet.small();
  const double number = text_width(std::to_string(count), text);
  return 0.9 * text + (number <= pitch ? 0.9 * text : number);
}

void draw_box(Drawing& drawing, const Plot& plot, double x, double pitch, std::size_t series,
              const std::vector<double>& values) {
  const std::string style = " " + box_style(series);
  const Beyond beyond = count_beyond(values, plot.y_range);
  draw_beyond(drawing, x, pitch, plot.top, beyond.above, true, series);
  draw_beyond(drawing, x, pitch, plot.top + plot.height, beyond.below, false, series);
  if (values.size() < kMinBoxValues) return draw_dots(drawing, plot, x, pitch, values, style);
  const BoxPlot box = box_plot(values);
  const double width = 0.6 * pitch;
  const double left = x - width / 2.0;
  draw_whiskers(drawing, plot, x, width, box, style);
  draw_quartiles(drawing, plot, left, width, box, style);
  if (is_inside(box.median, plot.y_range)) {
    const double y = plot.y(box.median);
    drawing.line(left, y, left + width, y, "median" + style);
  }
  draw_dots(drawing, plot, x, pitch, box.outliers, style);
}

}  // namespace croon::experiments

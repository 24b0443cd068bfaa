#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/statistics.hpp"
#include "framework/picture/drawing.hpp"

namespace croon {

/// A linear axis with ticks at round numbers.
struct Axis {
  double low;
  double high;
  std::vector<double> ticks;
  int decimals;  ///< Decimals of the tick labels.
};

/// The axis that contains [low, high], with about `ticks` steps of 1, 2 or 5 times a power of ten.
Axis round_axis(double low, double high, int ticks);

/// A rectangle of a drawing, with a linear scale from left to right and one from bottom to top.
struct Plot {
  double left, top, width, height;
  Interval x_range, y_range;  ///< The values at its sides.

  /// The position of a value in the drawing.
  double x(double value) const;
  double y(double value) const;
  /// The same, clamped to the borders of the plot.
  double y_inside(double value) const;

  /// Draws a line across the plot at the value of a tick, and `text` `gap` units to the left of
  /// the plot, or with its base line `gap` units below it.
  void draw_x_tick(Drawing& drawing, double value, const std::string& text, double gap) const;
  void draw_y_tick(Drawing& drawing, double value, const std::string& text, double gap,
                   const std::string& style = "grid") const;
};

/// The style of the lines of the series `index`: neighbours differ by colour and by dash, and 40
/// series differ by one of the two.
std::string series_style(std::size_t index);

/// The style of the outline of the box of the series `index`: solid up to the eighth, then dashed,
/// because colours repeat.
std::string box_style(std::size_t index);

/// Draws the intervals at the ascending `xs` as a band of the series `index`: a translucent area
/// between edges with the dashes of the series, so that bands are distinguishable without colours.
/// It has a gap where an interval is missing. `ys` and `xs` are values of `plot`.
void draw_band(Drawing& drawing, const Plot& plot, const std::vector<double>& xs,
               const std::vector<std::optional<Interval>>& ys, std::size_t index);

/// Draws the marker of the series `index`, about 2 `radius` wide.
void draw_marker(Drawing& drawing, double x, double y, double radius, std::size_t index);

/// Draws a bar of the series `index`, without its marker. The outline is dashed where markers
/// repeat, so that 35 series differ without colours.
void draw_bar(Drawing& drawing, double x, double y, double width, double height, std::size_t index);

/// Draws an arrowhead at (x, y) that points up or down, about 2 `radius` wide.
void draw_arrowhead(Drawing& drawing, double x, double y, double radius, bool is_up,
                    const std::string& style);

/// Whether the marks of series are lines or bars.
enum class SeriesMark { line, bar };

/// Draws a legend entry with a line or bar in the style of the series `index` and its name, centred
/// on `y`. The line or bar is `legend_line` long.
void draw_legend_entry(Drawing& drawing, double left, double y, std::size_t index,
                       const std::string& name, SeriesMark mark = SeriesMark::line);
double legend_line(const Sheet& sheet);

/// Labels for a legend. Parts, separated by slashes, that all names share are omitted; labels
/// longer than `columns` are cut in the middle. Labels that would then be equal are prefixed with
/// their number in the list.
std::vector<std::string> distinct_labels(const std::vector<std::string>& names,
                                         std::size_t columns);

}  // namespace croon

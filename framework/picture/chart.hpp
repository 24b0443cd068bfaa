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
  int decimals;  ///< That the ticks need.
};

/// The axis that holds [low, high] with about `ticks` steps of 1, 2 or 5 times a power of ten.
Axis round_axis(double low, double high, int ticks);

/// A rectangle of a drawing, with a linear scale from left to right and one from bottom to top.
struct Plot {
  double left, top, width, height;
  Interval x_range, y_range;  ///< The values at its sides.

  /// Where a value is in the drawing.
  double x(double value) const;
  double y(double value) const;
  /// The same for a value beyond the plot, moved to its border.
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

/// Draws the intervals at `xs`, which ascend, as a band of the series `index`: an area that lets
/// others through, between edges with the dashes of the series, so that bands can be told apart
/// without colours. It has a gap if an interval is missing. `ys` and `xs` are values of `plot`.
void draw_band(Drawing& drawing, const Plot& plot, const std::vector<double>& xs,
               const std::vector<std::optional<Interval>>& ys, std::size_t index);

/// Draws the marker of the series `index`, about 2 `radius` wide.
void draw_marker(Drawing& drawing, double x, double y, double radius, std::size_t index);

/// Draws an arrowhead at (x, y) that points up or down, about 2 `radius` wide.
void draw_arrowhead(Drawing& drawing, double x, double y, double radius, bool is_up,
                    const std::string& style);

/// Draws a line of a legend with the look of the series `index` and its name, centred on `y`.
/// The line is `legend_line` long.
void draw_legend_entry(Drawing& drawing, double left, double y, std::size_t index,
                       const std::string& name);
double legend_line(const Sheet& sheet);

/// Names as legends show them. Parts, between slashes, that all names share are left out; what is
/// longer than `columns` is cut in the middle. Two that would then be the same have their number
/// in the list before them.
std::vector<std::string> distinct_labels(const std::vector<std::string>& names,
                                         std::size_t columns);

}  // namespace croon

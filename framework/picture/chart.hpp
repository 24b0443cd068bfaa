#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "framework/base/statistics.hpp"
#include "framework/picture/svg.hpp"

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

/// A rectangle of a picture in pixels, with a linear scale from left to right and one from bottom
/// to top.
struct Plot {
  double left, top, width, height;
  Interval x_range, y_range;  ///< The values at its sides.

  /// Where a value is in the picture.
  double x(double value) const;
  double y(double value) const;

  /// Draws a line across the plot at the value of a tick, and `text` `gap` pixels to the left of
  /// the plot, or with its base line `gap` pixels below it.
  void draw_x_tick(Svg& svg, double value, const std::string& text, double gap) const;
  void draw_y_tick(Svg& svg, double value, const std::string& text, double gap,
                   const std::string& style = "grid") const;
};

/// How many colours the classes c0, c1, ... of `kChartStyle` have.
inline constexpr std::size_t kChartColours = 8;

/// The style sheet of charts. Colours that colour-blind readers can tell apart (Okabe and Ito
/// 2008); they show on white and on black.
inline constexpr const char* kChartStyle =
    R"css(text { font: 12px sans-serif; fill: #222; }
.title { font-size: 14px; font-weight: bold; }
.small { font-size: 11px; fill: #555; }
.page { fill: #fff; }
.grid { stroke: #e2e2e2; }
.zero { stroke: #888; }
.box { fill-opacity: 0.35; stroke-width: 1.2; }
.line { stroke-width: 1.2; }
.median { stroke-width: 2.4; }
.band { stroke: none; fill-opacity: 0.15; }
.curve { stroke-width: 2; }
.dot { stroke: none; fill-opacity: 0.6; }
.c0 { stroke: #0072b2; fill: #0072b2; }
.c1 { stroke: #d55e00; fill: #d55e00; }
.c2 { stroke: #009e73; fill: #009e73; }
.c3 { stroke: #cc79a7; fill: #cc79a7; }
.c4 { stroke: #e69f00; fill: #e69f00; }
.c5 { stroke: #56b4e9; fill: #56b4e9; }
.c6 { stroke: #8c7a00; fill: #8c7a00; }
.c7 { stroke: #808080; fill: #808080; }
@media (prefers-color-scheme: dark) {
  text { fill: #ddd; }
  .small { fill: #aaa; }
  .page { fill: #16181c; }
  .grid { stroke: #33373d; }
  .zero { stroke: #8a8f98; }
  .c0 { stroke: #4aa8e0; fill: #4aa8e0; }
}
)css";

}  // namespace croon

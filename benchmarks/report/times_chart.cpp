#include "benchmarks/report/times_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/base/text.hpp"
#include "framework/picture/chart.hpp"

namespace croon::benchmarks {
namespace {

/// The exponents of ten around all values.
Interval exponents_around(const std::vector<TimesLine>& lines,
                          std::vector<double> TimesLine::*values) {
  Interval range = {std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
  for (const TimesLine& line : lines) {
    for (const double value : line.*values) {
      range.low = std::min(range.low, std::log10(value));
      range.high = std::max(range.high, std::log10(value));
    }
  }
  if (range.low > range.high) return {0.0, 1.0};
  const double margin = 0.08 * std::max(range.high - range.low, 0.5);
  return {range.low - margin, range.high + margin};
}

/// The values 1, 2 and 5 times a power of ten within the range; only powers if it is long.
std::vector<double> ticks_of(const Interval& exponents) {
  const bool is_long = exponents.high - exponents.low > 2.5;
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(exponents.low)); power <= exponents.high; ++power) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double exponent = power + std::log10(digit);
      if (is_long && digit != 1.0) continue;
      if (exponent < exponents.low || exponent > exponents.high) continue;
      ticks.push_back(exponent);
    }
  }
  return ticks;
}

std::string tick_text(double exponent) {
  const int decimals = std::max(0, static_cast<int>(std::ceil(-exponent - 1e-9)));
  return fixed_number(std::pow(10.0, exponent), decimals);
}

}  // namespace

Drawing times_chart(const std::string& title, const std::string& x_title,
                    const std::vector<TimesLine>& lines) {
  constexpr double kWidth = 860.0, kLegend = 210.0, kPlotHeight = 340.0;
  Plot plot{};
  plot.left = 64.0;
  plot.top = 40.0;
  plot.width = kWidth - plot.left - kLegend - 24.0;
  plot.height = kPlotHeight;
  plot.x_range = exponents_around(lines, &TimesLine::xs);
  plot.y_range = exponents_around(lines, &TimesLine::times_ms);
  Drawing drawing(kWidth, plot.top + kPlotHeight + 56.0);
  drawing.describe(title);
  drawing.rectangle(0.0, 0.0, drawing.width(), drawing.height(), "page");
  drawing.text(12.0, 22.0, title, Anchor::start, "title");
  for (const double tick : ticks_of(plot.x_range)) {
    plot.draw_x_tick(drawing, tick, tick_text(tick), 16.0);
  }
  for (const double tick : ticks_of(plot.y_range)) {
    plot.draw_y_tick(drawing, tick, tick_text(tick), 8.0);
  }
  drawing.text(plot.left + plot.width / 2.0, plot.top + plot.height + 40.0, x_title, Anchor::middle,
               "small");
  drawing.text(14.0, plot.top + plot.height / 2.0, "ms", Anchor::middle, "small", -90.0);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<Corner> corners;
    for (std::size_t k = 0; k < lines[i].xs.size(); ++k) {
      corners.push_back(
          {plot.x(std::log10(lines[i].xs[k])), plot.y(std::log10(lines[i].times_ms[k]))});
    }
    drawing.polyline(corners, "curve " + series_style(i));
    for (const Corner& corner : corners) draw_marker(drawing, corner[0], corner[1], 4.0, i);
    draw_legend_entry(drawing, plot.left + plot.width + 24.0,
                      plot.top + 10.0 + 22.0 * static_cast<double>(i), i, lines[i].name);
  }
  return drawing;
}

}  // namespace croon::benchmarks

#include "framework/picture/chart.hpp"

#include <algorithm>
#include <cmath>

namespace croon {

Axis round_axis(double low, double high, int ticks) {
  // A flat range still needs a height; what differs by less than rounding is flat.
  const double least = std::max(1e-6, 1e-9 * std::max(std::abs(low), std::abs(high)));
  if (high - low < least) {
    low -= least;
    high += least;
  }
  const double rough = (high - low) / ticks;
  const auto exponent = static_cast<int>(std::floor(std::log10(rough)));
  const double power = std::pow(10.0, exponent);
  const double digits = rough / power;
  const double step = power * (digits <= 1.0   ? 1.0
                               : digits <= 2.0 ? 2.0
                               : digits <= 5.0 ? 5.0
                                               : 10.0);
  Axis axis;
  axis.decimals = std::max(0, digits > 5.0 ? -exponent - 1 : -exponent);
  const double first = std::floor(low / step);
  const double last = std::ceil(high / step);
  for (double k = first; k <= last; k += 1.0) axis.ticks.push_back(k * step);
  axis.low = axis.ticks.front();
  axis.high = axis.ticks.back();
  return axis;
}

double Plot::x(double value) const {
  return left + width * (value - x_range.low) / (x_range.high - x_range.low);
}

double Plot::y(double value) const {
  return top + height * (y_range.high - value) / (y_range.high - y_range.low);
}

void Plot::draw_x_tick(Svg& svg, double value, const std::string& text, double gap) const {
  svg.line(x(value), top, x(value), top + height, "grid");
  svg.text(x(value), top + height + gap, text, Anchor::middle, "small");
}

void Plot::draw_y_tick(Svg& svg, double value, const std::string& text, double gap,
                       const std::string& style) const {
  svg.line(left, y(value), left + width, y(value), style);
  svg.text(left - gap, y(value) + 4.0, text, Anchor::end, "small");
}

}  // namespace croon

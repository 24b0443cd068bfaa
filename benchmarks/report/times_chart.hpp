#pragma once

#include <string>
#include <vector>

#include "framework/picture/drawing.hpp"

namespace croon::benchmarks {

/// A line of a chart: times over another quantity, both positive.
struct TimesLine {
  std::string name;
  std::vector<double> xs;  ///< Ascending.
  std::vector<double> times_ms;
};

/// The lines on two logarithmic axes, with times in milliseconds on the vertical one.
Drawing times_chart(const std::string& title, const std::string& x_title,
                    const std::vector<TimesLine>& lines);

}  // namespace croon::benchmarks

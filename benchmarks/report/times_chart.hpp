#pragma once

#include <string>
#include <vector>

#include "framework/picture/drawing.hpp"

namespace croon::benchmarks {

/// A line of a chart: times over something, both above zero.
struct TimesLine {
  std::string name;
  std::vector<double> xs;  ///< Ascending.
  std::vector<double> times_ms;
};

/// The lines on two logarithmic axes, with the times in milliseconds upwards.
Drawing times_chart(const std::string& title, const std::string& x_title,
                    const std::vector<TimesLine>& lines);

}  // namespace croon::benchmarks

#pragma once

#include <vector>

namespace croon::experiments {

/// A linear axis with ticks at round numbers.
struct Axis {
  double low;
  double high;
  std::vector<double> ticks;
  int decimals;  ///< That the ticks need.
};

/// The axis that holds [low, high] with about `ticks` steps of 1, 2 or 5 times a power of ten.
Axis round_axis(double low, double high, int ticks);

}  // namespace croon::experiments

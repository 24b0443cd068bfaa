#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "framework/picture/chart.hpp"

namespace croon::experiments {

// One box of a figure.

/// Fewer values than this are drawn as dots: they are too few for quartiles.
inline constexpr std::size_t kMinBoxValues = 5;

/// The numbers of values above and below an axis.
struct Beyond {
  std::size_t above = 0;
  std::size_t below = 0;
};

Beyond count_beyond(const std::vector<double>& values, const Interval& axis);

/// Whether the box or a whisker of the values extends beyond the axis.
bool is_cut(const std::vector<double>& values, const Interval& axis);

/// The height of the mark for `count` values beyond an axis; see `draw_box`.
double beyond_height(const Sheet& sheet, double pitch, std::size_t count);

/// Draws the values of the series `series` at `x` as a box, or as dots if there are fewer than
/// `kMinBoxValues`. A box or whisker that extends beyond the axis is cut there and left open,
/// without a side or a cap; an arrowhead shows the number of values beyond. `pitch` is the width
/// available to the box.
void draw_box(Drawing& drawing, const Plot& plot, double x, double pitch, std::size_t series,
              const std::vector<double>& values);

}  // namespace croon::experiments

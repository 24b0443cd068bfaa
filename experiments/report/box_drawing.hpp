#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "framework/picture/chart.hpp"

namespace croon::experiments {

// One box of a figure.

/// Fewer values than this are drawn as dots: their quartiles would say more than is known.
inline constexpr std::size_t kLeastBoxValues = 5;

/// The numbers of values above and below an axis.
struct Beyond {
  std::size_t above = 0;
  std::size_t below = 0;
};

Beyond count_beyond(const std::vector<double>& values, const Interval& axis);

/// Whether the box or a whisker of the values goes on beyond the axis.
bool is_cut(const std::vector<double>& values, const Interval& axis);

/// The height that the mark of `count` values beyond an axis wants; see `draw_box`.
double beyond_height(const Sheet& sheet, double pitch, std::size_t count);

/// Draws the values of the series `series` at `x` as a box, or as dots if they are few. What goes
/// on beyond the axis is cut there and left open: a box has no side, a whisker no end. Beyond the
/// axis is an arrowhead with the number of values that lie there. `pitch` is the width that the box
/// may take.
void draw_box(Drawing& drawing, const Plot& plot, double x, double pitch, std::size_t series,
              const std::vector<double>& values);

}  // namespace croon::experiments

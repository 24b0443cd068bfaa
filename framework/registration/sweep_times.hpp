#pragma once

#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// How a LiDAR that turns about the z axis of its own frame swept through its surroundings.
struct Sweep {
  double begin_rad = 0.0;  ///< The azimuth, from x towards y, at which the scan began.
  bool is_clockwise = false;
};

/// The sweep that the order of the points shows, if it is that of firing. Ring by ring it shows the
/// direction; the scan is then taken to begin at the negative x axis. Any other order shows
/// nothing, and the direction is then taken to be counterclockwise.
Sweep sweep_of(const Points& points);

/// When each point was measured if the scan was this sweep: 0 to `period_s`, the duration of one
/// revolution.
std::vector<double> sweep_times_s(const Points& points, const Sweep& sweep, double period_s);

}  // namespace croon

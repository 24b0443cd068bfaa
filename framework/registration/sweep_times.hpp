#pragma once

#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The sweep of a LiDAR that rotates about the z axis of its own frame.
struct Sweep {
  double begin_rad = 0.0;  ///< The azimuth, from x towards y, at which the scan began.
  bool is_clockwise = false;
};

/// The sweep inferred from the order of the points, if they are in firing order. If they are stored
/// ring by ring, only the direction can be inferred, and the scan is assumed to begin at the
/// negative x axis. Any other order reveals nothing; the direction is then assumed to be
/// counterclockwise.
Sweep sweep_of(const Points& points);

/// The measurement time of each point in this sweep: 0 to `period_s`, the duration of one
/// revolution.
std::vector<double> sweep_times_s(const Points& points, const Sweep& sweep, double period_s);

}  // namespace croon

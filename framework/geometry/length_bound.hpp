#pragma once

namespace croon {

/// The largest coordinate of a position that a file may give, in metres: no rig and no scene is as
/// large.
inline constexpr double kLargestCoordinate_m = 1e6;

/// The largest distance from the origin at which a result is a pose, in metres. Starts and poses
/// within kLargestCoordinate_m of each other stay far below it; a store takes larger numbers.
inline constexpr double kLargestDistance_m = 1e9;

}  // namespace croon

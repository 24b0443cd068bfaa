#pragma once

namespace croon {

/// The maximum coordinate of a position in a file, in metres; larger than any rig or scene.
inline constexpr double kMaxCoordinate_m = 1e6;

/// The maximum distance from the origin at which a result is a pose, in metres. Starts and poses
/// within kMaxCoordinate_m of each other stay far below it; a store accepts larger numbers.
inline constexpr double kMaxPoseDistance_m = 1e9;

}  // namespace croon

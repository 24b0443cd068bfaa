#pragma once

#include <array>
#include <optional>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/geometry/point_cloud.hpp"
#include "framework/picture/drawing.hpp"

namespace croon::experiments {

/// The occupied volume over the offset of one degree of freedom from a pose.
struct VolumeCurve {
  std::vector<double> offsets;     ///< Ascending, in deg or m.
  std::vector<double> volumes_m3;  ///< NaN where a point is 100 km away.
};

/// A curve per degree of freedom.
using VolumeCurves = std::array<VolumeCurve, 6>;

/// The volume of the leaves of 0.1 m that both clouds occupy together, with the source at
/// `T_target_source` moved by up to 2 deg and 0.5 m (see `moved`). Of large clouds, evenly spaced
/// points are used. Same bits for any number of threads.
VolumeCurves volume_curves(const Points& target, const Points& source,
                           const RigidTransform& T_target_source);

/// The figure of the curves, a panel per degree of freedom, with the result at 0 and, if known,
/// ground truth at `truth_offset` (rad and m, as the offset of `moved`).
Drawing volume_chart(const VolumeCurves& curves, const std::optional<Vector6d>& truth_offset,
                     const Sheet& sheet = {});

}  // namespace croon::experiments

#pragma once

#include <cstddef>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// The largest differences of two poses that agree: the angle of the rotation between them and the
/// distance of their origins.
struct PoseBounds {
  double rotation_rad = 0.0;
  double translation_m = 0.0;
};

/// Whether the two poses are within `bounds` (inclusive) of each other, as `pose_error` measures
/// it.
bool agree(const RigidTransform& a, const RigidTransform& b, const PoseBounds& bounds);

/// The mean rotation: the unit quaternion with the largest `q^T (sum q_i q_i^T) q` (Markley et al.
/// 2007). Neither the order nor the signs of quaternions matter; commutes with a turn from the left
/// or the right. Throws std::logic_error if `poses` is empty.
Eigen::Matrix3d mean_rotation(const std::vector<RigidTransform>& poses);

/// The mean rotation with the arithmetic mean of the translations; commutes with a motion from the
/// left. Throws std::logic_error if `poses` is empty.
RigidTransform mean_pose(const std::vector<RigidTransform>& poses);

/// The pose that most poses agree on, robust against outliers: the pose with the most others near
/// it (the smallest sum of `min(1, distance / bounds)`, ties by the smallest sum of distances),
/// then the mean of those within `bounds` of it. Of more than 2000 poses the first is looked for
/// among a sample, evenly spaced by x, and the mean is over all. `weights`, one per pose, are how
/// many votes a pose has in the search of the first; all have one if there are none. The same bits
/// for any order of the poses. Throws std::logic_error if `poses` is empty.
RigidTransform consensus_pose(const std::vector<RigidTransform>& poses, const PoseBounds& bounds,
                              const std::vector<double>& weights = {});

}  // namespace croon

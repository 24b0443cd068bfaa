#pragma once

#include <cstddef>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

/// How near two poses must be to agree: the angle of the rotation and the distance of the origins.
struct PoseBounds {
  double rotation_rad = 0.0;
  double translation_m = 0.0;
};

/// Whether the two poses are within `bounds` (inclusive) of each other, as `pose_error` measures
/// it.
bool agree(const RigidTransform& a, const RigidTransform& b, const PoseBounds& bounds);

/// The mean rotation: the unit quaternion with the largest `q^T (sum q_i q_i^T) q` (Markley et al.
/// 2007). Neither the order nor the signs of quaternions matter; commutes with a turn from the left
/// or the right. Throws std::logic_error where there are none.
Eigen::Matrix3d mean_rotation(const std::vector<RigidTransform>& poses);

/// The mean rotation with the arithmetic mean of the translations; commutes with a motion from the
/// left. Throws std::logic_error where there are none.
RigidTransform mean_pose(const std::vector<RigidTransform>& poses);

/// What most poses agree on, however far off the others are: the pose that the most others are near
/// (of least summed `min(1, distance / bounds)`, ties to the least summed distance), then the mean
/// of those within `bounds` of it. Of more than 2000 poses the first is looked for among a sample,
/// evenly spaced by x, and the mean is over all. The same bits for any order of the poses. Throws
/// std::logic_error where there are none.
RigidTransform consensus_pose(const std::vector<RigidTransform>& poses, const PoseBounds& bounds);

}  // namespace croon

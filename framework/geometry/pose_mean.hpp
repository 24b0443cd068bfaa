#pragma once

#include <cstddef>
#include <vector>

#include "framework/geometry/dof.hpp"

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

/// The mean rotation, the unit quaternion with the largest `q^T (sum q_i q_i^T) q` (Markley et al.
/// 2007), with the arithmetic mean of the translations. Neither the order of the poses nor the
/// signs of quaternions matter. The rotation commutes with a turn from the left or the right, the
/// pose with a motion from the left. Throws std::logic_error if `poses` is empty.
RigidTransform mean_pose(const std::vector<RigidTransform>& poses);

/// A pose and the inverse of its covariance, see PoseCovariance; zero if nothing is known of it.
struct InformedPose {
  RigidTransform pose;
  Matrix6d information = Matrix6d::Zero();
};

/// The pose with the information of its `covariance`.
InformedPose informed(const RigidTransform& pose, const Matrix6d& covariance);

/// The mean of independent observations of one pose, weighed by their information, with the sum of
/// it (the pose with the least squared Mahalanobis distance to all: Barfoot and Furgale, T-RO 2014,
/// section V). Directions without information stay as in the first pose. Throws std::logic_error
/// if `poses` is empty.
InformedPose informed_mean(const std::vector<InformedPose>& poses);

/// The pose that most poses agree on, robust against outliers: the pose with the most others near
/// it (the smallest sum of `min(1, distance / bounds)`, ties by the smallest sum of distances),
/// then the mean of those within `bounds` of it. Of more than 2000 poses the first is looked for
/// among a sample, evenly spaced by x, and the mean is over all. `weights`, one per pose, are how
/// many votes a pose has in the search of the first; all have one if there are none. The same bits
/// for any order of the poses. Throws std::logic_error if `poses` is empty.
RigidTransform consensus_pose(const std::vector<RigidTransform>& poses, const PoseBounds& bounds,
                              const std::vector<double>& weights = {});

/// The poses that `consensus_pose` is the mean of, as indices into `poses`, ascending.
std::vector<std::size_t> consensus_members(const std::vector<RigidTransform>& poses,
                                           const PoseBounds& bounds,
                                           const std::vector<double>& weights = {});

/// Poses of one sensor in several scenes that are farther apart went astray.
inline constexpr PoseBounds kNearStart = {0.05, 0.5};

/// One pose for the scenes of a rig to start from, each of which has one of `poses`: their
/// consensus within kNearStart. One pose alone is itself, to the last bit. Throws std::logic_error
/// if `poses` is empty.
RigidTransform common_start(const std::vector<RigidTransform>& poses);

}  // namespace croon

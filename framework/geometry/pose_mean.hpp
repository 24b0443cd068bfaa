#pragma once

#include <cstddef>
#include <vector>

#include "framework/geometry/dof.hpp"

namespace croon {

/// The maximum differences between two poses that agree: the angle of the rotation between them and
/// the distance of their origins.
struct PoseBounds {
  double rotation_rad = 0.0;
  double translation_m = 0.0;
};

/// Whether the two poses are within `bounds` (inclusive) of each other, as `pose_error` measures
/// it.
bool agree(const RigidTransform& a, const RigidTransform& b, const PoseBounds& bounds);

/// The mean rotation, i.e. the unit quaternion that maximises `q^T (sum q_i q_i^T) q` (Markley et
/// al. 2007), with the arithmetic mean of the translations. Independent of the order of the poses
/// and the signs of quaternions. The rotation commutes with rotations from the left or the right,
/// the pose with motions from the left. Throws std::logic_error if `poses` is empty.
RigidTransform mean_pose(const std::vector<RigidTransform>& poses);

/// A pose and the inverse of its covariance, see PoseCovariance; zero if nothing is known about it.
struct InformedPose {
  RigidTransform pose;
  Matrix6d information = Matrix6d::Zero();
};

/// The pose with the information of its `covariance`.
InformedPose informed(const RigidTransform& pose, const Matrix6d& covariance);

/// The mean of independent observations of one pose, weighted by their information, and the sum of
/// the information (the pose with the minimum squared Mahalanobis distance to all: Barfoot and
/// Furgale, T-RO 2014, section V). Directions without information stay as in the first pose. Throws
/// std::logic_error if `poses` is empty.
InformedPose informed_mean(const std::vector<InformedPose>& poses);

/// The pose on which most poses agree, robust against outliers: finds the pose with the most
/// neighbours (the minimum sum of `min(1, distance / bounds)`, ties by the minimum sum of
/// distances), then averages the poses within `bounds` of it. Above 2000 poses, the first step uses
/// a sample that is evenly spaced by x; the mean is always over all poses. `weights`, one per pose,
/// are the votes of a pose in the first step (default: 1). The same bits for any order of the
/// poses. Throws std::logic_error if `poses` is empty.
RigidTransform consensus_pose(const std::vector<RigidTransform>& poses, const PoseBounds& bounds,
                              const std::vector<double>& weights = {});

/// The poses that `consensus_pose` averages, as indices into `poses`, ascending.
std::vector<std::size_t> consensus_members(const std::vector<RigidTransform>& poses,
                                           const PoseBounds& bounds,
                                           const std::vector<double>& weights = {});

/// Bounds for the poses of one sensor in several scenes; poses farther apart are outliers.
inline constexpr PoseBounds kNearStart = {0.05, 0.5};

/// One start for all scenes of a rig, each of which has one of `poses`: their consensus within
/// kNearStart. A single pose is returned unchanged, to the last bit. Throws std::logic_error if
/// `poses` is empty.
RigidTransform common_start(const std::vector<RigidTransform>& poses);

}  // namespace croon

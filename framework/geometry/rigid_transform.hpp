#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// A rigid motion `p -> rotation * p + translation`, metres. `T_target_source` maps a point of the
/// source frame to the target frame; adjacent frames cancel: `T_a_c = T_a_b * T_b_c`.
struct RigidTransform {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  RigidTransform inverse() const {
    return {rotation.transpose(), -(rotation.transpose() * translation)};
  }
  RigidTransform operator*(const RigidTransform& other) const {
    return {rotation * other.rotation, rotation * other.translation + translation};
  }
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation * point + translation;
  }
  /// Whether all numbers are equal.
  bool operator==(const RigidTransform& other) const {
    return rotation == other.rotation && translation == other.translation;
  }
  bool operator!=(const RigidTransform& other) const { return !(*this == other); }
};

/// `Rz(yaw) Ry(pitch) Rx(roll)` from (roll, pitch, yaw) in radians.
Eigen::Matrix3d rotation_from_rpy(const Eigen::Vector3d& rpy_rad);

/// (roll, pitch, yaw) in radians with `R = Rz(yaw) Ry(pitch) Rx(roll)` and pitch in [-pi/2, pi/2].
Eigen::Vector3d rpy_from_rotation(const Eigen::Matrix3d& rotation);

/// The rotation by `|omega|` radians about `omega` (Rodrigues' formula).
Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& omega_rad);

/// The angle of a rotation in radians, in [0, pi]; accurate even for very small angles.
double rotation_angle(const Eigen::Matrix3d& rotation);

/// The rotation nearest to a matrix that rounding has moved off SO(3).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& matrix);

/// Whether the columns of `matrix` have unit length and are orthogonal and right-handed within
/// 1e-4: stages from outside the tree may compute in single precision.
bool is_rotation_matrix(const Eigen::Matrix3d& matrix);

/// The minimum rotation that turns the unit vector `from` into the unit vector `to` (axis `from x
/// to`, Rodrigues; paper, rough calibration). Opposite vectors rotate by pi about an axis
/// perpendicular to them.
Eigen::Matrix3d rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// The points of `cloud` (source frame) in the target frame.
Points transformed(const Points& cloud, const RigidTransform& T_target_source);

/// The unit quaternion of a rotation with a unique sign: the first non-zero coefficient, in the
/// order w, x, y, z, is positive.
Eigen::Quaterniond unit_quaternion(const Eigen::Matrix3d& rotation);

}  // namespace croon

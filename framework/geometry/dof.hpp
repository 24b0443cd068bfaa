#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "framework/geometry/rigid_transform.hpp"

namespace croon {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The degrees of freedom of a pose, in the order of every six-vector and 6x6 matrix in croon:
/// three rotations about the axes of the reference frame (rad), three translations along them (m).
enum class Dof : std::size_t { roll, pitch, yaw, x, y, z };

/// "roll", "pitch", "yaw", "x", "y", "z".
inline const std::array<std::string, 6> kDofNames = {"roll", "pitch", "yaw", "x", "y", "z"};

/// True for roll, pitch and yaw.
inline bool is_rotation(Dof dof) { return dof < Dof::x; }

/// The pose (R, t) moved to (Rz Ry Rx R, t + d) by `offset` = (roll, pitch, yaw, d): the rotation
/// turns the sensor about its own origin, the translation is along the axes of the reference frame.
RigidTransform moved(const RigidTransform& T_target_source, const Vector6d& offset);

/// The pose (R, t) after the step (w, d) of an iteration: (exp(w) R, t + d), with R
/// re-orthonormalised. A step is limited to half a radian, beyond which the linearisation is
/// invalid.
RigidTransform stepped(const RigidTransform& T_target_source, const Vector6d& step);

/// The error of an estimated `T_reference_sensor`, in the reference frame (as in the paper's
/// tables): roll, pitch, yaw of `T_estimate * T_truth^-1`, and the difference of the translations.
struct PoseError {
  Vector6d dof = Vector6d::Zero();  ///< roll, pitch, yaw in rad; x, y, z in m.
  double rotation_rad = 0.0;        ///< The angle of the rotation between the two poses.
  double translation_m = 0.0;       ///< The distance between the two origins.
};

/// The error of `estimate` against `truth`, both `T_reference_sensor`.
PoseError pose_error(const RigidTransform& estimate, const RigidTransform& truth);

}  // namespace croon

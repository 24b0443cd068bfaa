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

}  // namespace croon

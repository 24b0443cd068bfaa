#pragma once

#include "framework/geometry/dof.hpp"

namespace croon {

/// The velocity of a rigid body, in the body's own frame. With a constant velocity, the body moves
/// along a screw: a straight line, an arc, a helix.
struct Twist {
  Eigen::Vector3d angular_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d linear_mps = Eigen::Vector3d::Zero();
};

/// The matrix of the cross product with `v`: `cross_matrix(v) * w` is `v x w`. For an angular
/// velocity `v`, it maps points to their velocities.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v);

/// The six components of a velocity: about the axes in rad/s, along them in m/s.
Vector6d vector_of(const Twist& velocity);

/// The velocity plus `step`, in the order of `vector_of`.
Twist stepped(const Twist& velocity, const Vector6d& step);

/// The motion `T_now_later` of a body with the constant `velocity` over `time_s` seconds: the
/// exponential of SE(3) (Barfoot, State Estimation for Robotics, 2017, eq. 7.85 and 7.86).
RigidTransform motion_over(const Twist& velocity, double time_s);

/// The velocity of a frame a that is fixed to the body, from the velocity `velocity_b` of the frame
/// b: the adjoint of `T_a_b`.
Twist velocity_in(const RigidTransform& T_a_b, const Twist& velocity_b);

/// The same as a matrix, in the order of `vector_of`.
Matrix6d adjoint(const RigidTransform& T_a_b);

}  // namespace croon

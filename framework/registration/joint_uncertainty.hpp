#pragma once

#include "framework/registration/joint_pair.hpp"

namespace croon {

/// The covariance of the velocity for which `target` was motion-compensated (about the axes in
/// rad/s, along them in m/s), in the `state` that register_jointly found: the jackknife over cubes
/// of space (see pose_uncertainty), with the poses of the sensors free. Moving objects occupy few
/// cubes, and their speed is not that of the car: where such cubes are decisive, leaving one out
/// changes the velocity. Each scene is judged by itself, even if others share its poses. Limited to
/// the covariance of a velocity without any observations (JointOptions::velocity_std).
Matrix6d velocity_covariance(const DeskewedTarget& target, const JointState& state,
                             const JointOptions& options);

/// For each source of the scene, the standard deviation, in m, of its translation that is due to
/// the `covariance` of that velocity. A sensor that sees the same surfaces as the target at the
/// same time hardly moves.
std::vector<double> shift_std_m(const DeskewedTarget& target, const Matrix6d& covariance,
                                const JointState& state, const JointOptions& options);

}  // namespace croon

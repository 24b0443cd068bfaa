#pragma once

#include "framework/registration/joint_pair.hpp"

namespace croon {

/// The covariance of the velocity of the scene of `target`, with which it was made still (about the
/// axes in rad/s, along them in m/s), in the `state` that register_jointly found: the jackknife
/// over cubes of space (see pose_uncertainty), with the poses of the sensors free. What moves by
/// itself is in a few cubes, and its speed is not that of the car: where such cubes decide, leaving
/// one out changes the velocity. The scene is judged by itself, also where others share its poses.
/// No velocity is less known than one of which no point was seen (JointOptions::velocity_std).
Matrix6d velocity_covariance(const StillTarget& target, const JointState& state,
                             const JointOptions& options);

/// What is not known of that velocity, with its `covariance`, moves each source of the scene
/// by so much: the standard deviation of its translation, m. A sensor that sees what the target
/// sees at the same time hardly moves.
std::vector<double> shift_std_m(const StillTarget& target, const Matrix6d& covariance,
                                const JointState& state, const JointOptions& options);

}  // namespace croon

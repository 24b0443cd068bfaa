#pragma once

#include "framework/registration/joint_registration.hpp"

namespace croon {

/// The covariance of the `velocity` of a scene (about the axes in rad/s, along them in m/s) in the
/// `state` that register_jointly found: the jackknife over cubes of space (see pose_uncertainty),
/// with the poses of the sensors free. What moves by itself is in a few cubes,
/// and its speed is not that of the car: where such cubes decide, leaving one out changes the
/// velocity. The scene is judged by itself, also where others share its poses.
Matrix6d velocity_covariance(const JointScene& scene, const Twist& velocity,
                             const JointState& state, const JointOptions& options);

/// What is not known of the velocity of a scene, with its `covariance`, moves each of its sources
/// by so much: the standard deviation of its translation, m. A sensor that sees what the target
/// sees at the same time hardly moves.
std::vector<double> shift_std_m(const JointScene& scene, const Twist& velocity,
                                const Matrix6d& covariance, const JointState& state,
                                const JointOptions& options);

}  // namespace croon

#pragma once

#include "framework/geometry/dof.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/stage/extras.hpp"

namespace croon {

/// The velocity of the target's sensor while it scanned, as a step estimated it or knew it.
inline constexpr Extra<Twist> kMotion{
    "motion", "the velocity of the target's sensor, by which the clouds were corrected"};

/// Its covariance: about the axes in rad/s, along them in m/s.
inline constexpr Extra<Matrix6d> kMotionCovariance{"motion_covariance",
                                                   "the covariance of that velocity"};

}  // namespace croon

#pragma once

#include "framework/geometry/dof.hpp"
#include "framework/geometry/twist.hpp"
#include "framework/stage/extras.hpp"

namespace croon {

/// The velocity of the target's sensor during its scan, estimated or known by a step.
inline constexpr Extra<Twist> kMotion{
    "motion", "the velocity of the target's sensor for which the clouds were corrected"};

/// Its covariance: about the axes in rad/s, along them in m/s.
inline constexpr Extra<Matrix6d> kMotionCovariance{"motion_covariance",
                                                   "the covariance of that velocity"};

/// Whether no motion was removed from the clouds: none was looked for, or the rig was at rest.
inline bool is_at_rest(const Extras& extras) {
  const Twist* const velocity = extras.find(kMotion);
  return velocity == nullptr || vector_of(*velocity).isZero(0.0);
}

/// Provided with the value true if another velocity explains the clouds nearly as well, so that the
/// pose is rejected.
inline constexpr Extra<bool> kMotionInDoubt{
    "motion_in_doubt", "whether another velocity explains the clouds nearly as well"};

}  // namespace croon

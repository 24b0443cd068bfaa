#pragma once

#include "framework/geometry/twist.hpp"
#include "framework/stage/extras.hpp"

namespace croon {

/// The velocity of the target's sensor while it scanned, as a step estimated it.
inline constexpr Extra<Twist> kMotion{
    "motion", "the velocity of the target's sensor, by which the clouds were corrected"};

}  // namespace croon

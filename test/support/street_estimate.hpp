#pragma once

#include <cstdint>
#include <string>

#include "framework/stage/step.hpp"

namespace croon::test {

/// Two clouds as they are, at `T_target_source`. `seed` decides what their stages draw.
Estimate estimate_of(Points target, Points source, const RigidTransform& T_target_source,
                     std::uint64_t seed = 1);

/// A diagnostic of the last step, by its name; NaN and a failure of the test if there is none.
double diagnostic(const Estimate& estimate, const std::string& name);

/// Two sensors in one street, as the pipeline sees them before its first step.
struct StreetEstimate {
  RigidTransform truth;  ///< T_target_source.
  Estimate estimate;     ///< At the truth; move its T_target_source to where a test starts.
};

/// The target stands level 2 m above the street, the source is pitched, rolled and turned beside
/// it; other points of the same surfaces, 1 cm of noise.
StreetEstimate street_estimate(std::uint64_t seed);

}  // namespace croon::test

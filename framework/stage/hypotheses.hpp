#pragma once

#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/stage/extras.hpp"

namespace croon {

/// A pose that a global search found, and how well the clouds agree there (PoseEvidence::score).
struct Hypothesis {
  RigidTransform T_target_source;
  double score = 0.0;
};

/// The poses between which a global search chose, best first, no two of them near each other.
inline constexpr Extra<std::vector<Hypothesis>> kHypotheses{
    "hypotheses", "the poses between which a global search chose"};

}  // namespace croon

#pragma once

#include <vector>

#include "framework/base/angles.hpp"
#include "framework/geometry/pose_mean.hpp"
#include "framework/stage/extras.hpp"

namespace croon {

/// A pose that a global search found, and the agreement of the clouds there (PoseEvidence::score).
struct Hypothesis {
  RigidTransform T_target_source;
  double score = 0.0;
};

/// Poses that agree within these bounds are one hypothesis.
inline const PoseBounds kSameHypothesis = {rad_from_deg(1.0), 0.3};

/// The candidate poses of a global search, best first, no two of them near each other.
inline constexpr Extra<std::vector<Hypothesis>> kHypotheses{
    "hypotheses", "the candidate poses of a global search"};

/// The region to which a global search was restricted by an initial guess.
struct SearchRegion {
  RigidTransform start;
  PoseBounds bounds;
};

/// Present only if a search was restricted; poses elsewhere are excluded by the initial guess.
inline constexpr Extra<SearchRegion> kSearchRegion{
    "search_region", "the region around the initial guess to which a search was restricted"};

/// Present only with the value true, if another pose explains the clouds about as well.
inline constexpr Extra<bool> kAmbiguous{"ambiguous",
                                        "whether another pose explains the clouds about as well"};

}  // namespace croon

#pragma once

#include <vector>

#include "framework/base/rng.hpp"
#include "framework/geometry/plane.hpp"

namespace croon {

/// Which planes of a cloud may be the ground.
struct GroundCandidateOptions {
  double threshold_m = 0.15;    ///< Points within this distance of a plane are on it.
  double max_range_m = 40.0;    ///< Points farther away are not used.
  double min_height_m = 0.2;    ///< Of the sensor above the plane.
  double max_height_m = 6.0;    ///< Likewise.
  double below_margin_m = 0.5;  ///< A point this far behind a plane speaks against it.
  int planes = 8;               ///< Planes are taken from the cloud, largest first.
  int candidates = 3;           ///< The most plausible of them are returned.
  /// And none whose score is less than the best by more than this.
  double max_gap = 0.6;
};

/// A plane that may be the ground, its normal towards the sensor, and how plausible it is.
struct GroundCandidate {
  Plane plane;
  double score = 0.0;  ///< Share of the points on it, less twice that behind it.
};

/// The planes of `thinned` (the sensor's frame; thinned evenly, so that a number of points is an
/// area) that may be the ground, the most plausible first. Nothing is known of the mounting: the
/// normal is turned to the sensor, and a road has few returns behind it. Empty if there is none.
std::vector<GroundCandidate> ground_candidates(const Points& thinned,
                                               const GroundCandidateOptions& options, Rng& rng);

}  // namespace croon

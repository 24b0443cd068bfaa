#pragma once

#include <vector>

#include "framework/base/rng.hpp"
#include "framework/geometry/plane.hpp"

namespace croon {

/// Criteria for planes of a cloud that may be the ground.
struct GroundCandidateOptions {
  double threshold_m = 0.15;  ///< Points within this distance of a plane are its inliers.
  double max_range_m = 40.0;  ///< Points farther away are ignored.
  double min_height_m = 0.2;  ///< Of the sensor above the plane.
  double max_height_m = 6.0;  ///< Likewise.
  double below_margin_m =
      0.5;             ///< Points farther than this behind a plane are evidence against it.
  int planes = 8;      ///< Number of planes extracted, largest first.
  int candidates = 3;  ///< Maximum number of planes returned, the most plausible ones.
  /// Maximum difference between the best score and that of a returned plane.
  double max_gap = 0.6;
};

/// A plane that may be the ground, with its normal towards the sensor, and its plausibility.
struct GroundCandidate {
  Plane plane;
  double score = 0.0;  ///< Fraction of points on the plane, minus twice the fraction behind it.
};

/// The planes of `thinned` (in the sensor's frame; thinned evenly, so that numbers of points
/// measure area) that may be the ground, the most plausible first. The mounting is assumed unknown:
/// the normal points to the sensor, and a road has few returns behind it. May be empty.
std::vector<GroundCandidate> ground_candidates(const Points& thinned,
                                               const GroundCandidateOptions& options, Rng& rng);

}  // namespace croon

#pragma once

#include <vector>

#include "framework/params/table.hpp"
#include "framework/stage/ground_extractor.hpp"

namespace croon {

/// The criteria for the ground plane; common to all extractors, so that their non-ground points are
/// comparable. An extractor's own parameters derive from this and its table inherits
/// ground_rule_table().
struct GroundRule {
  /// Maximum distance of a ground point from the plane.
  double threshold_m = 0.2;
  /// The plane is fitted to the points within this distance (at most `threshold_m`). It is smaller
  /// than `threshold_m`, because the wider slab contains kerbs, wheels and the feet of walls, all
  /// of which are above the ground.
  double refit_threshold_m = 0.05;
  /// The minimum share of the points on the ground.
  double min_inlier_ratio = 0.05;
};

/// The rows of GroundRule.
const params::Table<GroundRule>& ground_rule_table();

/// The ground of `cloud`, given candidate planes: the slab with the most points (paper, rough
/// calibration), and within it the narrower slab with the most points, fitted to them by least
/// squares. Throws StageError if no plane contains enough points.
Ground ground_from_planes(const Points& cloud, const std::vector<Plane>& planes,
                          const GroundRule& rule, Rng& rng);

}  // namespace croon

#pragma once

#include <vector>

#include "framework/params/table.hpp"
#include "framework/stage/ground_extractor.hpp"

namespace croon {

/// Which plane is the ground; the same for every extractor, so that their non-ground points can be
/// compared. An extractor's own parameters derive from this and its table inherits
/// ground_rule_table().
struct GroundRule {
  /// A point is ground within this distance of the plane.
  double threshold_m = 0.2;
  /// The plane is fitted to the points within this distance of it (at most `threshold_m`). It is
  /// smaller than `threshold_m`, because kerbs, wheels and the feet of walls are in the wider slab,
  /// all above the ground.
  double refit_threshold_m = 0.05;
  /// The ground holds at least this share of the points.
  double min_inlier_ratio = 0.05;
};

/// The rows of GroundRule.
const params::Table<GroundRule>& ground_rule_table();

/// The ground of `cloud` among candidate planes: the slab with the most points (paper, rough
/// calibration), and within it the narrower slab with the most points, fitted to them by least
/// squares. Throws StageError if no plane holds enough points.
Ground ground_from_planes(const Points& cloud, const std::vector<Plane>& planes,
                          const GroundRule& rule, Rng& rng);

}  // namespace croon

#include "framework/stage/ground_from_planes.hpp"

#include <algorithm>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/geometry/plane.hpp"

namespace croon {
namespace {

/// The points near the plane of `planes` with the most points near it; the first in case of ties.
Points fullest_slab(const Points& cloud, const std::vector<Plane>& planes, double threshold_m) {
  std::vector<int> most;
  for (const Plane& plane : planes) {
    std::vector<int> indices = points_within(cloud, plane, threshold_m);
    if (indices.size() > most.size()) most = std::move(indices);
  }
  if (most.empty()) throw StageError("no plane was found for the ground");
  Points slab;
  for (const int i : most) slab.push_back(cloud[i]);
  return slab;
}

/// The plane with the most points in a slab. A least-squares fit to the whole slab would follow a
/// kerb in it, even after narrowing the slab.
Plane narrowed(const Points& slab, double threshold_m, Rng& rng) {
  constexpr int kMaxRounds = 30;
  PlaneRansacOptions options;
  options.threshold_m = threshold_m;
  Plane plane = plane_ransac(slab, options, rng);
  std::vector<int> before;
  for (int round = 0; round < kMaxRounds; ++round) {
    std::vector<int> indices = points_within(slab, plane, threshold_m);
    if (indices == before) break;
    plane = fit_plane(slab, indices);
    before = std::move(indices);
  }
  return plane;
}

}  // namespace

const params::Table<GroundRule>& ground_rule_table() {
  static const params::Table<GroundRule> table = {
      params::number("threshold_m", &GroundRule::threshold_m, {1e-4, 10.0},
                     "Maximum distance of ground points from the plane; the authors use 0.2."),
      params::number(
          "refit_threshold_m", &GroundRule::refit_threshold_m, {1e-4, 10.0},
          "Maximum distance of the points for the final fit of the plane, which excludes kerbs and "
          "wheels; limited to threshold_m."),
      params::number("min_inlier_ratio", &GroundRule::min_inlier_ratio, {0.0, 1.0},
                     "Minimum share of the points on the ground; with fewer the stage fails."),
  };
  return table;
}

Ground ground_from_planes(const Points& cloud, const std::vector<Plane>& planes,
                          const GroundRule& rule, Rng& rng) {
  Ground ground;
  ground.plane = narrowed(fullest_slab(cloud, planes, rule.threshold_m),
                          std::min(rule.refit_threshold_m, rule.threshold_m), rng);
  ground.is_ground.assign(cloud.size(), 0);
  const std::vector<int> indices = points_within(cloud, ground.plane, rule.threshold_m);
  for (const int i : indices) ground.is_ground[i] = 1;
  if (static_cast<double>(indices.size()) <
      rule.min_inlier_ratio * static_cast<double>(cloud.size())) {
    std::ostringstream message;
    message << "no plane contains " << 100.0 * rule.min_inlier_ratio << " % of the " << cloud.size()
            << " points; the largest contains " << indices.size();
    throw StageError(message.str());
  }
  return ground;
}

}  // namespace croon

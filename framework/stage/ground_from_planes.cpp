#include "framework/stage/ground_from_planes.hpp"

#include <algorithm>
#include <sstream>

#include "framework/base/error.hpp"
#include "framework/geometry/plane.hpp"

namespace croon {
namespace {

/// The points near that plane of `planes` which has the most points near it; of equals the first.
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

/// The plane with the most points of a slab. A least-squares fit to the whole slab would follow a
/// kerb in it, also after the slab is made narrower.
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
                     "A point within this distance of the plane is ground; the authors' 0.2."),
      params::number(
          "refit_threshold_m", &GroundRule::refit_threshold_m, {1e-4, 10.0},
          "The final fit of the plane uses the points within this distance, without kerbs "
          "and wheels; never more than threshold_m."),
      params::number("min_inlier_ratio", &GroundRule::min_inlier_ratio, {0.0, 1.0},
                     "The stage fails if no plane holds this share of the points."),
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
    message << "no plane holds " << 100.0 * rule.min_inlier_ratio << " % of the " << cloud.size()
            << " points; the largest holds " << indices.size();
    throw StageError(message.str());
  }
  return ground;
}

}  // namespace croon

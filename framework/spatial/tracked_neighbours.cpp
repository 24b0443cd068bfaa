#include "framework/spatial/tracked_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace croon {
namespace {

/// More than the rounding of a distance in single precision, so that margins are conservative.
constexpr float kRounding = 1e-5F;

/// Searches extend beyond the requested distance, so that a point without a neighbour has a margin
/// too.
constexpr float kReach = 1.1F;

}  // namespace

float TrackedNeighbours::reach_m(const Track& track, const Eigen::Vector3f& query,
                                 float max_distance_m) const {
  const float reach_m = max_distance_m * kReach;
  if (track.second < 0) return reach_m;
  const float both_within_m2 = std::max(squared_distance_m2(query, target_[track.nearest]),
                                        squared_distance_m2(query, target_[track.second]));
  return std::min(reach_m, std::sqrt(both_within_m2) * (1.0F + kRounding));
}

Neighbour TrackedNeighbours::nearest(int index, const Eigen::Vector3f& query,
                                     float max_distance_m) {
  Track& track = tracks_[static_cast<std::size_t>(index)];
  const float moved_m = std::sqrt(squared_distance_m2(query, track.query));
  const float rest_beyond_m =
      track.rest_beyond_m * (1.0F - kRounding) - moved_m * (1.0F + kRounding);
  if (rest_beyond_m > 0.0F) {
    const float known_m2 = track.nearest >= 0 ? squared_distance_m2(query, target_[track.nearest])
                                              : std::numeric_limits<float>::infinity();
    if (known_m2 < rest_beyond_m * rest_beyond_m) {
      return known_m2 <= max_distance_m * max_distance_m ? Neighbour{track.nearest, known_m2}
                                                         : Neighbour{};
    }
    if (max_distance_m < rest_beyond_m) return {};
  }
  const NearestAndRest found = tree_.nearest_and_rest(query, reach_m(track, query, max_distance_m));
  track = {query, found.nearest.index, found.second, std::sqrt(found.rest_beyond_m2)};
  return found.nearest && found.nearest.squared_distance_m2 <= max_distance_m * max_distance_m
             ? found.nearest
             : Neighbour{};
}

}  // namespace croon

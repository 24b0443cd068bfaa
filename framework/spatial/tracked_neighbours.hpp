#pragma once

#include <vector>

#include "framework/spatial/cloud.hpp"

namespace croon {

/// The nearest neighbours of points that move a little between queries, as in a registration. A
/// search also returns a bound for the distances of all points but the nearest. While a point is
/// nearer to its old neighbour than any other point can be, it needs no search (Greenspan & Godin
/// 2001, "A nearest neighbor method for efficient ICP"); otherwise its two old neighbours bound the
/// search. The results are those of KdTree::nearest.
class TrackedNeighbours {
 public:
  /// For `count` points, numbered from 0; `target` must outlive this.
  TrackedNeighbours(const Cloud& target, std::size_t count)
      : target_(target.points()), tree_(target.kd_tree()), tracks_(count) {}

  /// The nearest point within `max_distance_m` of point `index`, now at `query`.
  Neighbour nearest(int index, const Eigen::Vector3f& query, float max_distance_m);

 private:
  /// The result of the last search for a point.
  struct Track {
    Eigen::Vector3f query = Eigen::Vector3f::Zero();
    int nearest = -1;
    int second = -1;
    float rest_beyond_m = -1.0F;  ///< Negative before the first search.
  };

  /// The radius within which the next search for a point is certain to find the two nearest.
  float reach_m(const Track& track, const Eigen::Vector3f& query, float max_distance_m) const;

  const Points& target_;
  const KdTree& tree_;
  std::vector<Track> tracks_;
};

}  // namespace croon

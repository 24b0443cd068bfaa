#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// One neighbour: the index of the point in its cloud and its squared distance in m^2.
struct Neighbour {
  int index = -1;  ///< -1 if no point is near enough.
  float squared_distance_m2 = 0.0F;
  explicit operator bool() const { return index >= 0; }
};

/// The nearest two points, and a bound for the distances of all points but the nearest.
struct NearestAndRest {
  Neighbour nearest;            ///< The nearest point within the search radius.
  int second = -1;              ///< The second nearest within the radius.
  float rest_beyond_m2 = 0.0F;  ///< Minimum squared distance of all points but the nearest, m^2.
};

/// `dx^2 + dy^2 + dz^2` in single precision, summed in this order: bitwise the distance that KdTree
/// computes.
inline float squared_distance_m2(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const float x = a.x() - b.x();
  const float y = a.y() - b.y();
  const float z = a.z() - b.z();
  return x * x + y * y + z * z;
}

/// Nearest neighbours in a fixed cloud. Of points at the same distance, the one with the smallest
/// index counts as nearer, so results depend only on the points and not on how the tree divides
/// them. Queries may run on many threads at once.
///
/// A kd-tree (Bentley 1975, "Multidimensional binary search trees used for associative searching")
/// for current processors: cells are split at the median of their longest edge; three splits make a
/// node of eight children, whose tight boxes are tested at once; and the coordinates of a leaf are
/// contiguous, so that the compiler computes four distances with one instruction. See
/// docs/design.md for the gain over nanoflann.
class KdTree {
 public:
  explicit KdTree(const Points& points);
  KdTree(const KdTree& other);
  ~KdTree();
  KdTree& operator=(const KdTree&) = delete;

  /// Moves all points, in their order, to new positions. Keeps the structure of the tree, which
  /// takes less than a tenth of the time of building it; searches are as fast as long as near
  /// points stay near each other. Throws std::invalid_argument if the numbers of points differ.
  void move_to(const Points& points);

  /// The nearest point within `max_distance_m` of `query`.
  Neighbour nearest(const Eigen::Vector3f& query, float max_distance_m) const;
  /// The nearest point at any distance.
  Neighbour nearest(const Eigen::Vector3f& query) const;
  /// The nearest point within `reach_m` of `query`, and the squared distance of the second, or
  /// `reach_m` squared if the second is farther away.
  NearestAndRest nearest_and_rest(const Eigen::Vector3f& query, float reach_m) const;
  /// Writes the `count` nearest points (fewer in a smaller cloud) to `neighbours`. Searches within
  /// `guess_m` first, then everywhere: a good guess makes the search faster. The set of points does
  /// not depend on the guess or the tree; their order does.
  void nearest(const Eigen::Vector3f& query, int count, std::vector<Neighbour>& neighbours,
               float guess_m = 0.0F) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace croon

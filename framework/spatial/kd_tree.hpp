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

/// The nearest two points, and how far away all others than the nearest are.
struct NearestAndRest {
  Neighbour nearest;            ///< The nearest point within the reach of the search.
  int second = -1;              ///< The second nearest within the reach.
  float rest_beyond_m2 = 0.0F;  ///< No point but the nearest has a smaller squared distance, m^2.
};

/// `dx^2 + dy^2 + dz^2` in single precision, summed in this order: the distance that a KdTree
/// finds, to the last bit.
inline float squared_distance_m2(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const float x = a.x() - b.x();
  const float y = a.y() - b.y();
  const float z = a.z() - b.z();
  return x * x + y * y + z * z;
}

/// Nearest neighbours in a fixed cloud. Of points at the same distance the one with the least index
/// is the nearer, so an answer depends on the points alone and not on how the tree divides them.
/// Queries may run on many threads at once.
///
/// A kd-tree (Bentley 1975, "Multidimensional binary search trees used for associative searching")
/// for the processors of today: cells are split at the median of their longest edge, three splits
/// make a node of eight children, whose tight boxes are tested at once, and the coordinates of a
/// leaf lie side by side, so that the compiler computes four distances with one instruction. See
/// docs/design.md for what that gains over nanoflann.
class KdTree {
 public:
  explicit KdTree(const Points& points);
  /// The points of `tree`, in the same order, at other places. They are divided as in `tree`, which
  /// takes a tenth of the time of dividing them anew; searches are as fast if near points stay near
  /// one another. Throws std::invalid_argument if the numbers of points differ.
  KdTree(const KdTree& tree, const Points& moved);
  ~KdTree();
  KdTree(const KdTree&) = delete;
  KdTree& operator=(const KdTree&) = delete;

  /// The nearest point within `max_distance_m` of `query`.
  Neighbour nearest(const Eigen::Vector3f& query, float max_distance_m) const;
  /// The nearest point, however far.
  Neighbour nearest(const Eigen::Vector3f& query) const;
  /// The nearest point within `reach_m` of `query`, and the squared distance of the second, or of
  /// the reach if that is nearer.
  NearestAndRest nearest_and_rest(const Eigen::Vector3f& query, float reach_m) const;
  /// The `count` nearest points (fewer in a smaller cloud), written to `neighbours`. They are first
  /// looked for within `guess_m`, then everywhere: a good guess makes the search faster. Which
  /// points they are does not depend on it or on the tree; their order does.
  void nearest(const Eigen::Vector3f& query, int count, std::vector<Neighbour>& neighbours,
               float guess_m = 0.0F) const;

 private:
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace croon

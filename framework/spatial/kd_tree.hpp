#pragma once

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

/// Nearest neighbours in a fixed cloud (nanoflann's kd-tree). The cloud must outlive the tree.
/// Queries may run on many threads at once and give the same answer every time.
class KdTree {
 public:
  explicit KdTree(const Points& points);
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
  /// The `count` nearest points (fewer in a smaller cloud), nearest first, written to `neighbours`.
  void nearest(const Eigen::Vector3f& query, int count, std::vector<Neighbour>& neighbours) const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace croon

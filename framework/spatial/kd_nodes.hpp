#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The nodes and leaves of a KdTree.
struct KdNodes {
  static constexpr int kSplits = 3;  ///< Of a node; two are slower where a search has a bound.
  static constexpr int kChildren = 1 << kSplits;
  static constexpr int kLeafSize = 24;  ///< The fastest of 8, 16, 24 and 32.
  using Distances = Eigen::Array<float, kLeafSize, 1>;
  using Indices = std::array<int, kLeafSize>;

  /// Points side by side; places without a point are infinitely far and have the index -1.
  struct Leaf {
    std::array<Distances, 3> coordinates;
    Indices indices;
  };

  /// The boxes and places of the children. A box without points is infinitely far.
  struct Node {
    using PerChild = Eigen::Array<float, kChildren, 1>;
    std::array<PerChild, 3> low, high;
    std::array<int, kChildren> children;  ///< A node, or ~ of a leaf.
  };

  explicit KdNodes(const Points& points);

  /// Replaces the coordinates of all points, in their order, and adapts the boxes. No point changes
  /// its leaf.
  void move_to(const Points& points);

  int size;       ///< How many points there are.
  int root = -1;  ///< As in Node.
  std::vector<Node> nodes;
  std::vector<Leaf> leaves;
};

}  // namespace croon

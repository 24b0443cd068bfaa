#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The nodes and leaves of a KdTree.
struct KdNodes {
  static constexpr int kSplits = 3;  ///< Per node; with two, bounded searches are slower.
  static constexpr int kChildren = 1 << kSplits;
  static constexpr int kLeafSize = 24;  ///< The fastest of 8, 16, 24 and 32.
  using Distances = Eigen::Array<float, kLeafSize, 1>;
  using Indices = std::array<int, kLeafSize>;

  /// Points side by side; unused entries are infinitely far away and have the index -1.
  struct Leaf {
    std::array<Distances, 3> coordinates;
    Indices indices;
  };

  /// The boxes and indices of the children. A box without points is infinitely far away.
  struct Node {
    using PerChild = Eigen::Array<float, kChildren, 1>;
    std::array<PerChild, 3> low, high;
    std::array<int, kChildren> children;  ///< Index of a node, or ~index of a leaf.
  };

  explicit KdNodes(const Points& points);

  /// Replaces the coordinates of all points, in their order, and updates the boxes. Points stay in
  /// their leaves.
  void move_to(const Points& points);

  int size;       ///< Number of points.
  int root = -1;  ///< As in Node.
  std::vector<Node> nodes;
  std::vector<Leaf> leaves;
};

}  // namespace croon

#include "framework/spatial/kd_nodes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace croon {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Divides the points recursively until they fit into leaves.
class KdBuilder {
 public:
  KdBuilder(const Points& points, KdNodes& tree) : tree_(tree) {
    points_.reserve(points.size());
    for (const Eigen::Vector3f& point : points) {
      points_.push_back({point, static_cast<int>(points_.size())});
    }
    tree_.leaves.reserve(points.size() / kLeafSize + 1);
    tree_.nodes.reserve(points.size() / (2 * kLeafSize) + 1);
  }

  void build() {
    if (!points_.empty()) tree_.root = subtree({0, static_cast<int>(points_.size())});
  }

 private:
  using Leaf = KdNodes::Leaf;
  using Node = KdNodes::Node;
  static constexpr int kLeafSize = KdNodes::kLeafSize;

  struct IndexedPoint {
    Eigen::Vector3f point;
    int index;
  };
  struct Range {
    int begin, end;
    bool is_leaf() const { return end - begin <= kLeafSize; }
  };

  Eigen::AlignedBox3f box_of(Range range) const {
    Eigen::AlignedBox3f box;
    for (int i = range.begin; i < range.end; ++i) box.extend(points_[i].point);
    return box;
  }

  /// Splits near the median of the longest edge, such that all leaves of the first part are full.
  int split(Range range) {
    Eigen::Index axis = 0;
    box_of(range).sizes().maxCoeff(&axis);
    const int leaves = (range.end - range.begin + kLeafSize - 1) / kLeafSize;
    const int middle = range.begin + (leaves + 1) / 2 * kLeafSize;
    std::nth_element(points_.begin() + range.begin, points_.begin() + middle,
                     points_.begin() + range.end,
                     [axis](const IndexedPoint& a, const IndexedPoint& b) {
                       return a.point[axis] < b.point[axis];
                     });
    return middle;
  }

  int leaf(Range range) {
    Leaf leaf;
    leaf.coordinates.fill(KdNodes::Distances::Constant(kInfinity));
    leaf.indices.fill(-1);
    for (int i = range.begin; i < range.end; ++i) {
      const int place = i - range.begin;
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        leaf.coordinates[axis][place] = points_[i].point[axis];
      }
      leaf.indices[place] = points_[i].index;
    }
    tree_.leaves.push_back(leaf);
    return ~static_cast<int>(tree_.leaves.size() - 1);
  }

  /// The halves of each range that is not a leaf.
  std::vector<Range> halves(const std::vector<Range>& ranges) {
    std::vector<Range> parts;
    for (const Range range : ranges) {
      if (range.is_leaf()) {
        parts.push_back(range);
      } else {
        const int middle = split(range);
        parts.push_back({range.begin, middle});
        parts.push_back({middle, range.end});
      }
    }
    return parts;
  }

  /// Adds the subtree over a range; returns its index, as in Node.
  int subtree(Range range) {
    if (range.is_leaf()) return leaf(range);
    std::vector<Range> parts = {range};
    for (int i = 0; i < KdNodes::kSplits; ++i) parts = halves(parts);
    const std::size_t place = tree_.nodes.size();
    tree_.nodes.emplace_back();
    Node node;
    node.children.fill(0);
    node.low.fill(Node::PerChild::Constant(kInfinity));
    node.high.fill(Node::PerChild::Constant(kInfinity));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Eigen::AlignedBox3f box = box_of(parts[i]);
      for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][static_cast<Eigen::Index>(i)] = box.min()[axis];
        node.high[axis][static_cast<Eigen::Index>(i)] = box.max()[axis];
      }
      node.children[i] = subtree(parts[i]);
    }
    tree_.nodes[place] = node;
    return static_cast<int>(place);
  }

  KdNodes& tree_;
  std::vector<IndexedPoint> points_;
};

}  // namespace

KdNodes::KdNodes(const Points& points) : size(static_cast<int>(points.size())) {
  KdBuilder(points, *this).build();
}

void KdNodes::move_to(const Points& points) {
  const auto box_of_leaf = [](const Leaf& leaf) {
    Eigen::AlignedBox3f box;
    for (int axis = 0; axis < 3; ++axis) {
      const Distances& all = leaf.coordinates[axis];
      box.min()[axis] = all.minCoeff();  // Unused entries are infinite.
      box.max()[axis] = (all < kInfinity).select(all, -kInfinity).maxCoeff();
    }
    return box;
  };
  const auto is_empty = [](const Node& node, int child) { return std::isinf(node.low[0][child]); };
  const auto box_of_node = [&](const Node& node) {
    Eigen::AlignedBox3f box;
    for (int child = 0; child < kChildren; ++child) {
      if (is_empty(node, child)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        box.min()[axis] = std::min(box.min()[axis], node.low[axis][child]);
        box.max()[axis] = std::max(box.max()[axis], node.high[axis][child]);
      }
    }
    return box;
  };
  for (Leaf& leaf : leaves) {
    for (int i = 0; i < kLeafSize && leaf.indices[i] >= 0; ++i) {
      const Eigen::Vector3f& point = points[leaf.indices[i]];
      for (int axis = 0; axis < 3; ++axis) leaf.coordinates[axis][i] = point[axis];
    }
  }
  // Children come after their parents.
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) {
    for (int child = 0; child < kChildren; ++child) {
      if (is_empty(*node, child)) continue;
      const int place = node->children[child];
      const Eigen::AlignedBox3f box =
          place < 0 ? box_of_leaf(leaves[~place]) : box_of_node(nodes[place]);
      for (int axis = 0; axis < 3; ++axis) {
        node->low[axis][child] = box.min()[axis];
        node->high[axis][child] = box.max()[axis];
      }
    }
  }
}

}  // namespace croon

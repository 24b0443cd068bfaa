#include "framework/spatial/kd_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace croon {
namespace {

/// Beyond every point, and nearer than a place of a leaf without a point.
constexpr float kUnbounded = std::numeric_limits<float>::max();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Whether a point is nearer than the best one so far. If there is none, the best distance is the
/// bound of the search, which is within.
bool is_nearer(float squared_distance, int index, float best_squared_distance, int best_index) {
  return squared_distance < best_squared_distance ||
         (squared_distance == best_squared_distance && (best_index < 0 || index < best_index));
}

/// The bits of floats that are not negative are in the order of the floats.
std::uint32_t bits_of(float value) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

float float_of(std::uint32_t bits) {
  float value = 0.0F;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

constexpr int kLeafSize = 24;  // The fastest of 8, 16, 24 and 32.
constexpr int kChildren = 4;
using Distances = Eigen::Array<float, kLeafSize, 1>;
using Indices = std::array<int, kLeafSize>;
struct IndexedPoint {
  Eigen::Array3f point;
  int index;
};

using Box = std::array<Eigen::Array3f, 2>;  ///< The least and the greatest coordinates.

/// Points side by side; places without a point are infinitely far and have the index -1.
struct Leaf {
  std::array<Distances, 3> coordinates;
  Indices indices;
};

/// The boxes and places of four children. A box without points is infinitely far.
struct Node {
  using PerChild = Eigen::Array<float, kChildren, 1>;
  std::array<PerChild, 3> low, high;
  std::array<int, kChildren> children;  ///< A node, or ~ of a leaf.
};

}  // namespace

struct KdTree::Tree {
  explicit Tree(const Points& points);

  /// Shows `result` the leaves that have points within `result.bound_m2()`, nearest box first.
  template <class Result>
  void search(const Eigen::Vector3f& query, Result& result) const;

  int size;
  int root = -1;  ///< As in Node.
  std::vector<Node> nodes;
  std::vector<Leaf> leaves;

 private:
  class Builder;
};

/// Divides the points until a leaf holds them.
class KdTree::Tree::Builder {
 public:
  Builder(const Points& points, Tree& tree) : tree_(tree) {
    points_.reserve(points.size());
    for (const Eigen::Vector3f& point : points) {
      points_.push_back({point.array(), static_cast<int>(points_.size())});
    }
    tree_.leaves.reserve(points.size() / kLeafSize + 1);
    tree_.nodes.reserve(points.size() / (2 * kLeafSize) + 1);
  }

  void build() {
    if (!points_.empty()) tree_.root = subtree({0, static_cast<int>(points_.size())});
  }

 private:
  struct Range {
    int begin, end;
    bool is_leaf() const { return end - begin <= kLeafSize; }
  };

  Box box_of(Range range) const {
    Box box = {points_[range.begin].point, points_[range.begin].point};
    for (int i = range.begin + 1; i < range.end; ++i) {
      box[0] = box[0].min(points_[i].point);
      box[1] = box[1].max(points_[i].point);
    }
    return box;
  }

  /// Near the median of the longest edge, so that all leaves of the first part are full.
  int split(Range range) {
    const Box box = box_of(range);
    Eigen::Index axis = 0;
    (box[1] - box[0]).maxCoeff(&axis);
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
    leaf.coordinates.fill(Distances::Constant(kInfinity));
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

  /// The place of the subtree over a range, as in Node.
  int subtree(Range range) {
    if (range.is_leaf()) return leaf(range);
    std::vector<Range> parts;
    const int middle = split(range);
    for (const Range half : {Range{range.begin, middle}, Range{middle, range.end}}) {
      if (half.is_leaf()) {
        parts.push_back(half);
      } else {
        const int quarter = split(half);
        parts.push_back({half.begin, quarter});
        parts.push_back({quarter, half.end});
      }
    }
    const std::size_t place = tree_.nodes.size();
    tree_.nodes.emplace_back();
    Node node;
    node.children.fill(0);
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis].setConstant(kInfinity);
      node.high[axis].setConstant(kInfinity);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Box box = box_of(parts[i]);
      for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][static_cast<Eigen::Index>(i)] = box[0][axis];
        node.high[axis][static_cast<Eigen::Index>(i)] = box[1][axis];
      }
      node.children[i] = subtree(parts[i]);
    }
    tree_.nodes[place] = node;
    return static_cast<int>(place);
  }

  Tree& tree_;
  std::vector<IndexedPoint> points_;
};

KdTree::Tree::Tree(const Points& points) : size(static_cast<int>(points.size())) {
  Builder(points, *this).build();
}

template <class Result>
void KdTree::Tree::search(const Eigen::Vector3f& query, Result& result) const {
  struct Place {
    float squared_distance;
    int place;
  };
  // Each level of the tree leaves three siblings at most; 2^31 points have less than 16 levels.
  std::array<Place, 64> waiting;
  int count = 0;
  if (size > 0) waiting[count++] = {0.0F, root};
  while (count > 0) {
    const Place next = waiting[--count];
    // The same operations in the same order as for a point: rounding never makes a box farther off
    // than a point in it.
    if (next.squared_distance > result.bound_m2()) continue;
    if (next.place < 0) {
      const Leaf& leaf = leaves[~next.place];
      Distances squared = (leaf.coordinates[0] - query.x()).square();
      squared += (leaf.coordinates[1] - query.y()).square();
      squared += (leaf.coordinates[2] - query.z()).square();
      result.visit(squared, leaf.indices);
      continue;
    }
    const Node& node = nodes[next.place];
    Node::PerChild squared = Node::PerChild::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      squared +=
          (node.low[axis] - query[axis]).max(query[axis] - node.high[axis]).max(0.0F).square();
    }
    const int first = count;
    for (int i = 0; i < kChildren; ++i) {
      if (squared[i] > result.bound_m2()) continue;
      int at = count++;
      for (; at > first && waiting[at - 1].squared_distance < squared[i]; --at) {
        waiting[at] = waiting[at - 1];
      }
      waiting[at] = {squared[i], node.children[i]};
    }
  }
}

namespace {

class NearestResult {
 public:
  explicit NearestResult(float bound_m2) { best_.squared_distance_m2 = bound_m2; }
  float bound_m2() const { return best_.squared_distance_m2; }
  const Neighbour& best() const { return best_; }

  void visit(const Distances& squared, const Indices& indices) {
    const float least = squared.minCoeff();
    if (least > best_.squared_distance_m2) return;
    for (int i = 0; i < kLeafSize; ++i) {
      if (squared[i] == least &&
          is_nearer(least, indices[i], best_.squared_distance_m2, best_.index)) {
        best_ = {indices[i], least};
      }
    }
  }

 private:
  Neighbour best_;
};

class NearestTwoResult {
 public:
  explicit NearestTwoResult(float bound_m2) {
    found_.nearest.squared_distance_m2 = bound_m2;
    found_.rest_beyond_m2 = bound_m2;
  }
  float bound_m2() const { return found_.rest_beyond_m2; }
  const NearestAndRest& found() const { return found_; }

  void visit(const Distances& squared, const Indices& indices) {
    if (squared.minCoeff() > found_.rest_beyond_m2) return;
    for (int i = 0; i < kLeafSize; ++i) {
      Neighbour& nearest = found_.nearest;
      if (squared[i] > found_.rest_beyond_m2) continue;
      if (is_nearer(squared[i], indices[i], nearest.squared_distance_m2, nearest.index)) {
        found_.rest_beyond_m2 = nearest.squared_distance_m2;
        found_.second = nearest.index;
        nearest = {indices[i], squared[i]};
      } else if (is_nearer(squared[i], indices[i], found_.rest_beyond_m2, found_.second)) {
        found_.rest_beyond_m2 = squared[i];
        found_.second = indices[i];
      }
    }
  }

 private:
  NearestAndRest found_;
};

/// Candidates are collected unordered, and from time to time all but the nearest are dropped.
class NearestManyResult {
 public:
  NearestManyResult(int wanted, float bound_m2) : wanted_(wanted), bound_m2_(bound_m2) {
    const std::size_t room = static_cast<std::size_t>(most() + kLeafSize);
    if (squared().size() < room) {
      squared().resize(room);
      indices().resize(room);
    }
  }
  float bound_m2() const { return bound_m2_; }
  int count() const { return count_; }

  void visit(const Distances& squared_distances, const Indices& places) {
    float* const squared = this->squared().data();
    int* const indices = this->indices().data();
    for (int i = 0; i < kLeafSize; ++i) {
      squared[count_] = squared_distances[i];
      indices[count_] = places[i];
      count_ += static_cast<int>(squared_distances[i] <= bound_m2_);
    }
    if (count_ > most()) drop_farthest();
  }

  void write_nearest_first(std::vector<Neighbour>& neighbours) {
    if (count_ > wanted_) drop_farthest();
    neighbours.resize(static_cast<std::size_t>(count_));
    const float* const squared = this->squared().data();
    const int* const indices = this->indices().data();
    for (int i = 0; i < count_; ++i) {
      int nearer = 0;  // Without branches it is faster than a sort.
      for (int k = 0; k < count_; ++k) {
        nearer += static_cast<int>(squared[k] < squared[i]) |
                  (static_cast<int>(squared[k] == squared[i]) &
                   static_cast<int>(indices[k] < indices[i]));
      }
      neighbours[static_cast<std::size_t>(nearer)] = {indices[i], squared[i]};
    }
  }

 private:
  int most() const { return wanted_ + 2 * kLeafSize; }
  static std::vector<float>& squared() {
    thread_local std::vector<float> memory;
    return memory;
  }
  static std::vector<int>& indices() {
    thread_local std::vector<int> memory;
    return memory;
  }

  /// Leaves the wanted number of candidates, of more than these.
  void drop_farthest() {
    float* const squared = this->squared().data();
    const auto within = [&](float bound_m2) {
      int count = 0;
      for (int i = 0; i < count_; ++i) count += static_cast<int>(squared[i] <= bound_m2);
      return count;
    };
    // The least distance within which enough of them are, from `low` to `high`. On a surface their
    // number grows with the squared distance, so every other step interpolates; the ones between
    // halve the bits, which ends for any points.
    std::uint32_t low = 0, high = bits_of(Eigen::Map<Eigen::ArrayXf>(squared, count_).maxCoeff());
    int below = 0, enough = count_;
    for (bool interpolates = true; low < high && enough != wanted_; interpolates = !interpolates) {
      std::uint32_t middle = low + (high - low) / 2;
      if (interpolates) {
        const float share =
            static_cast<float>(wanted_ - below) / static_cast<float>(enough - below);
        const float between = float_of(low) + share * (float_of(high) - float_of(low));
        middle = std::clamp(bits_of(between), low, high - 1);
      }
      const int count = within(float_of(middle));
      if (count >= wanted_) {
        high = middle;
        enough = count;
      } else {
        low = middle + 1;
        below = count;
      }
    }
    bound_m2_ = float_of(high);
    keep([&](int i) { return squared[i] <= bound_m2_; });
    // Of those at the same distance the ones with the greatest indices go.
    while (count_ > wanted_) {
      const int* const indices = this->indices().data();
      int last = -1;
      for (int i = 0; i < count_; ++i) {
        if (squared[i] == bound_m2_) last = std::max(last, indices[i]);
      }
      keep([&](int i) { return squared[i] != bound_m2_ || indices[i] != last; });
    }
  }

  template <class Predicate>
  void keep(const Predicate& is_kept) {
    float* const squared = this->squared().data();
    int* const indices = this->indices().data();
    int kept = 0;
    for (int i = 0; i < count_; ++i) {
      const bool stays = is_kept(i);
      squared[kept] = squared[i];
      indices[kept] = indices[i];
      kept += static_cast<int>(stays);
    }
    count_ = kept;
  }

  int wanted_;
  float bound_m2_;
  int count_ = 0;
};

}  // namespace

KdTree::KdTree(const Points& points) : tree_(std::make_unique<const Tree>(points)) {}
KdTree::~KdTree() = default;

Neighbour KdTree::nearest(const Eigen::Vector3f& query, float max_distance_m) const {
  NearestResult result(std::min(max_distance_m * max_distance_m, kUnbounded));
  tree_->search(query, result);
  return result.best();
}

Neighbour KdTree::nearest(const Eigen::Vector3f& query) const {
  NearestResult result(kUnbounded);
  tree_->search(query, result);
  return result.best();
}

NearestAndRest KdTree::nearest_and_rest(const Eigen::Vector3f& query, float reach_m) const {
  NearestTwoResult result(std::min(reach_m * reach_m, kUnbounded));
  tree_->search(query, result);
  return result.found();
}

void KdTree::nearest(const Eigen::Vector3f& query, int count, std::vector<Neighbour>& neighbours,
                     float guess_m) const {
  const int wanted = std::min(count, tree_->size);
  neighbours.clear();
  if (wanted <= 0) return;
  NearestManyResult result(wanted, std::min(guess_m * guess_m, kUnbounded));
  if (guess_m > 0.0F) tree_->search(query, result);
  if (result.count() < wanted) {
    result = NearestManyResult(wanted, kUnbounded);
    tree_->search(query, result);
  }
  result.write_nearest_first(neighbours);
}

}  // namespace croon

#include "framework/spatial/kd_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/spatial/kd_nodes.hpp"

namespace croon {
namespace {

using Distances = KdNodes::Distances;
using Indices = KdNodes::Indices;
using Node = KdNodes::Node;
constexpr int kChildren = KdNodes::kChildren;
constexpr int kLeafSize = KdNodes::kLeafSize;

/// The squared distance at which an unbounded search starts: larger than that of every point,
/// smaller than that of an unused entry of a leaf.
constexpr float kUnbounded = std::numeric_limits<float>::max();

/// Whether a point is nearer than the best one so far. Initially, the best distance is the bound of
/// the search, which is inclusive.
bool is_nearer(float squared_distance, int index, float best_squared_distance, int best_index) {
  return squared_distance < best_squared_distance ||
         (squared_distance == best_squared_distance && (best_index < 0 || index < best_index));
}

/// The bits of non-negative floats have the same order as the floats.
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

/// Subtrees that a search may have to visit.
class Waiting {
 public:
  struct Place {
    float squared_distance;  ///< From the query to its box.
    int place;               ///< As in Node.
  };
  bool empty() const { return count_ == 0; }
  Place pop() { return places_[--count_]; }

  /// Adds the children of a node that are within the bound, nearest last.
  void push(const Node& node, const Node::PerChild& squared, float bound_m2) {
    // Usually there is one. A mispredicted branch costs more than the unnecessary computation.
    unsigned within = 0;
    for (int i = 0; i < kChildren; ++i) {
      within |= squared.data()[i] <= bound_m2 ? 1U << i : 0U;
    }
    const int first = count_;
    for (; within != 0; within &= within - 1) {
      const int child = __builtin_ctz(within);
      int at = count_++;
      for (; at > first && places_[at - 1].squared_distance < squared[child]; --at) {
        places_[at] = places_[at - 1];
      }
      places_[at] = {squared[child], node.children[child]};
    }
  }
  void push(const Place& place) { places_[count_++] = place; }

 private:
  // Each level leaves at most seven siblings, and 2^31 points have ten levels.
  std::array<Place, 10 * kChildren> places_;
  int count_ = 0;
};

/// Passes all leaves that may have points within `result.bound_m2()` to `result`, nearest box
/// first.
template <class Result>
void search(const KdNodes& tree, const Eigen::Vector3f& query, Result& result) {
  Waiting waiting;
  if (tree.size > 0) waiting.push({0.0F, tree.root});
  while (!waiting.empty()) {
    const Waiting::Place next = waiting.pop();
    if (next.squared_distance > result.bound_m2()) continue;
    // The same operations in the same order for boxes and points, so that rounding never makes a
    // box more distant than a point in it.
    if (next.place < 0) {
      const KdNodes::Leaf& leaf = tree.leaves[~next.place];
      Distances squared = (leaf.coordinates[0] - query.x()).square();
      squared += (leaf.coordinates[1] - query.y()).square();
      squared += (leaf.coordinates[2] - query.z()).square();
      result.visit(squared, leaf.indices);
    } else {
      const Node& node = tree.nodes[next.place];
      const auto outside = [&](int axis) -> Node::PerChild {
        return (node.low[axis] - query[axis]).max(query[axis] - node.high[axis]).max(0.0F).square();
      };
      Node::PerChild squared = outside(0);
      squared += outside(1);
      squared += outside(2);
      waiting.push(node, squared, result.bound_m2());
    }
  }
}

class NearestResult {
 public:
  explicit NearestResult(float bound_m2) { best_.squared_distance_m2 = bound_m2; }
  float bound_m2() const { return best_.squared_distance_m2; }
  const Neighbour& best() const { return best_; }

  void visit(const Distances& squared, const Indices& indices) {
    const float min_squared = squared.minCoeff();
    if (min_squared > best_.squared_distance_m2) return;
    constexpr int kNone = std::numeric_limits<int>::max();
    int first = kNone;
    for (int i = 0; i < kLeafSize; ++i) {
      const int index = squared.data()[i] == min_squared ? indices.data()[i] : kNone;
      first = index < first ? index : first;
    }
    if (is_nearer(min_squared, first, best_.squared_distance_m2, best_.index))
      best_ = {first, min_squared};
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

/// Collects candidates unordered, and occasionally drops all but the nearest.
class NearestManyResult {
 public:
  NearestManyResult(int wanted, float bound_m2) : wanted_(wanted), bound_m2_(bound_m2) {
    const auto room = static_cast<std::size_t>(max_candidates()) + kLeafSize;
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
    if (count_ > max_candidates()) drop_farthest();
  }

  void write(std::vector<Neighbour>& neighbours) {
    if (count_ > wanted_) drop_farthest();
    neighbours.resize(static_cast<std::size_t>(count_));
    const float* const squared = this->squared().data();
    const int* const indices = this->indices().data();
    for (int i = 0; i < count_; ++i) neighbours[i] = {indices[i], squared[i]};
  }

 private:
  int max_candidates() const { return wanted_ + 2 * kLeafSize; }
  static std::vector<float>& squared() {
    thread_local std::vector<float> memory;
    return memory;
  }
  static std::vector<int>& indices() {
    thread_local std::vector<int> memory;
    return memory;
  }

  /// Drops the farthest candidates, so that only the requested number is left.
  void drop_farthest() {
    float* const squared = this->squared().data();
    const auto within = [&](float bound_m2) {
      int count = 0;
      for (int i = 0; i < count_; ++i) count += static_cast<int>(squared[i] <= bound_m2);
      return count;
    };
    // Finds the minimum distance that includes enough of them, between `low` and `high`. On a
    // surface their number grows with the squared distance, so every other step interpolates; the
    // others bisect the bits, which terminates for any points.
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
    // Of those at the same distance, the ones with the largest indices are dropped.
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

struct KdTree::Tree : KdNodes {
  using KdNodes::KdNodes;
};

KdTree::KdTree(const Points& points) : tree_(std::make_unique<Tree>(points)) {}

KdTree::KdTree(const KdTree& other) : tree_(std::make_unique<Tree>(*other.tree_)) {}

KdTree::~KdTree() = default;

void KdTree::move_to(const Points& points) {
  if (static_cast<int>(points.size()) != tree_->size) {
    throw std::invalid_argument("a moved tree needs " + std::to_string(tree_->size) +
                                " points, not " + std::to_string(points.size()));
  }
  tree_->move_to(points);
}

Neighbour KdTree::nearest(const Eigen::Vector3f& query, float max_distance_m) const {
  NearestResult result(std::min(max_distance_m * max_distance_m, kUnbounded));
  search(*tree_, query, result);
  return result.best();
}

Neighbour KdTree::nearest(const Eigen::Vector3f& query) const {
  NearestResult result(kUnbounded);
  search(*tree_, query, result);
  return result.best();
}

NearestAndRest KdTree::nearest_and_rest(const Eigen::Vector3f& query, float reach_m) const {
  NearestTwoResult result(std::min(reach_m * reach_m, kUnbounded));
  search(*tree_, query, result);
  return result.found();
}

void KdTree::nearest(const Eigen::Vector3f& query, int count, std::vector<Neighbour>& neighbours,
                     float guess_m) const {
  const int wanted = std::min(count, tree_->size);
  neighbours.clear();
  if (wanted <= 0) return;
  NearestManyResult result(wanted, std::min(guess_m * guess_m, kUnbounded));
  if (guess_m > 0.0F) search(*tree_, query, result);
  if (result.count() < wanted) {
    result = NearestManyResult(wanted, kUnbounded);
    search(*tree_, query, result);
  }
  result.write(neighbours);
}

}  // namespace croon

#include <array>
#include <cstdint>
#include <vector>

#include "framework/spatial/leaf_grid.hpp"
#include "framework/stage/leaf_scorer.hpp"

namespace croon::stages::volume_scorer {
namespace {

/// The paper's octree (refinement): a cube that contains points is divided into eight down to the
/// leaf size. The root's side is 2^depth leaves; it doubles towards a leaf outside it.
class Octree {
 public:
  std::int64_t leaves() const { return leaves_; }

  bool contains(const Eigen::Vector3i& leaf) const {
    if (!covers(leaf)) return false;
    const Vector3l offset = leaf.cast<std::int64_t>() - corner_;
    std::uint32_t node = kRoot;
    for (int level = depth_ - 1; level >= 0; --level) {
      node = nodes_[node][octant(offset, level)];
      if (node == kNone) return false;
    }
    return true;
  }

  void insert(const Eigen::Vector3i& leaf) {
    if (leaves_ == 0) corner_ = leaf.cast<std::int64_t>();
    while (!covers(leaf)) grow_towards(leaf);
    const Vector3l offset = leaf.cast<std::int64_t>() - corner_;
    std::uint32_t node = kRoot;
    for (int level = depth_ - 1; level > 0; --level) node = child(node, octant(offset, level));
    std::uint32_t& occupied = nodes_[node][octant(offset, 0)];
    if (occupied == kLeaf) return;
    occupied = kLeaf;
    ++leaves_;
  }

  /// Empties the tree and keeps its memory.
  void clear() {
    nodes_.assign(1, Node{});
    depth_ = 1;
    leaves_ = 0;
  }

 private:
  /// The eight children of a cube: indices into nodes_, or kNone; at the lowest level kLeaf or
  /// kNone.
  using Node = std::array<std::uint32_t, 8>;
  using Vector3l = Eigen::Matrix<std::int64_t, 3, 1>;
  static constexpr std::uint32_t kRoot = 0;
  static constexpr std::uint32_t kNone = 0;
  static constexpr std::uint32_t kLeaf = 1;

  /// The child, of a cube of side 2^(level + 1) leaves, that contains the leaf `offset` (from the
  /// root's corner).
  static std::size_t octant(const Vector3l& offset, int level) {
    return static_cast<std::size_t>((offset.x() >> level & 1) | (offset.y() >> level & 1) << 1 |
                                    (offset.z() >> level & 1) << 2);
  }

  bool covers(const Eigen::Vector3i& leaf) const {
    const Vector3l offset = leaf.cast<std::int64_t>() - corner_;
    // A negative offset has its high bits set.
    return (offset.x() | offset.y() | offset.z()) >> depth_ == 0;
  }

  std::uint32_t child(std::uint32_t node, std::size_t octant) {
    if (nodes_[node][octant] == kNone) {
      nodes_[node][octant] = static_cast<std::uint32_t>(nodes_.size());
      nodes_.emplace_back();
    }
    return nodes_[node][octant];
  }

  /// Makes the root one child of a root of twice the side.
  void grow_towards(const Eigen::Vector3i& leaf) {
    Vector3l old_offset = Vector3l::Zero();
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (leaf(axis) < corner_(axis)) old_offset(axis) = std::int64_t{1} << depth_;
    }
    corner_ -= old_offset;
    if (leaves_ > 0) {
      const Node old_root = nodes_[kRoot];
      nodes_[kRoot] = Node{};
      nodes_[child(kRoot, octant(old_offset, depth_))] = old_root;
    }
    ++depth_;
  }

  std::vector<Node> nodes_ = std::vector<Node>(1);
  Vector3l corner_ = Vector3l::Zero();  ///< The root's lowest leaf.
  int depth_ = 1;
  std::int64_t leaves_ = 0;
};

class PointerOctree final : public LeafSet {
 public:
  static constexpr const char* kName = "pointer_octree";

  PointerOctree(const LeafGrid& grid, const PointColumns& target,
                const RigidTransform& T_grid_target)
      : grid_(grid) {
    for (std::size_t i = 0; i < target.size(); ++i) {
      tree_.insert(grid_.leaf_of(T_grid_target * target.point(i)));
    }
  }

  std::int64_t leaves_with(const PointColumns& source,
                           const RigidTransform& T_grid_source) const override {
    // One per thread: reallocating its memory for each pose would take most of the time.
    thread_local Octree added;
    added.clear();
    for (std::size_t i = 0; i < source.size(); ++i) {
      const Eigen::Vector3i leaf = grid_.leaf_of(T_grid_source * source.point(i));
      if (!tree_.contains(leaf)) added.insert(leaf);
    }
    return tree_.leaves() + added.leaves();
  }

 private:
  LeafGrid grid_;
  Octree tree_;
};

}  // namespace

StageEntry pointer_octree() {
  return leaf_scorer_entry<PointerOctree>(
      "Divides every cube that contains points into eight down to the leaf size and counts the "
      "leaves.",
      "CROON (arXiv 2203.03182), refinement");
}

}  // namespace croon::stages::volume_scorer

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {

/// The points of a cloud with one array per coordinate, for vectorised code.
struct PointColumns {
  explicit PointColumns(const Points& points);
  std::size_t size() const { return x.size(); }
  Eigen::Vector3d point(std::size_t i) const { return {x[i], y[i], z[i]}; }

  std::vector<float> x, y, z;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< Of the bounding box.
  Eigen::Vector3d reach = Eigen::Vector3d::Zero();   ///< From the centre to a face of the box.
  bool finite = true;                                ///< Whether all coordinates are finite.
};

/// Leaves outside a window, sorted, without duplicates.
using FarLeaves = std::vector<LeafKey>;

/// The number of `leaves` that are not among `others`.
std::int64_t count_new(const FarLeaves& leaves, const FarLeaves& others);

/// A window of 2^21 leaves per axis of a LeafGrid (with leaves of 5 cm, 52 km to each side of the
/// centre), whose leaves have keys of 63 bits. A brick is a cube of 4 x 4 x 4 leaves; a leaf's key
/// is the key of its brick, shifted left by kLeafBits, plus the leaf's number in the brick. The
/// leaves are exactly those of LeafGrid::leaf_of.
class LeafWindow {
 public:
  static constexpr int kLeafBits = 6;
  /// Keys are computed in blocks of this size, which fit into the L1 cache.
  static constexpr std::size_t kBlock = 256;

  /// The implementation that computes the keys; all compute the same bits.
  enum class Instructions { any_processor, avx2 };
  /// The widest instructions of this processor.
  static Instructions best_instructions();

  /// The window around the leaf of `centre` (metres). Throws StageError outside the grid.
  LeafWindow(const LeafGrid& grid, const Eigen::Vector3d& centre);
  /// The window around the leaf of the middle element of the list, at `T_grid_points`.
  LeafWindow(const LeafGrid& grid, const PointColumns& points, const RigidTransform& T_grid_points);

  const LeafGrid& grid() const { return grid_; }

  /// The key of a leaf; std::nullopt outside the window.
  std::optional<std::uint64_t> key_of(const Eigen::Vector3i& leaf) const {
    const Eigen::Vector3i offset = leaf - corner_;
    if ((offset.array() < 0).any() || (offset.array() >= kWidth).any()) return std::nullopt;
    return key(static_cast<std::uint64_t>(offset.x()), static_cast<std::uint64_t>(offset.y()),
               static_cast<std::uint64_t>(offset.z()));
  }

  /// The key of the leaf with these offsets (0 .. 2^21 - 1) from the window's corner.
  static constexpr std::uint64_t key(std::uint64_t i, std::uint64_t j, std::uint64_t k) {
    return (i & 3) | (j & 3) << 2 | (k & 3) << 4 | i >> 2 << 6 | j >> 2 << 25 | k >> 2 << 44;
  }

  /// The inverse of `key`: the leaf's offsets from the window's corner.
  static std::array<std::uint64_t, 3> offsets(std::uint64_t key) {
    return {(key >> 6 & kBrickMask) << 2 | (key & 3),
            (key >> 25 & kBrickMask) << 2 | (key >> 2 & 3),
            (key >> 44 & kBrickMask) << 2 | (key >> 4 & 3)};
  }

  /// Calls `use(keys, count)` for blocks of the keys of all points at `T_target_source`, one key
  /// per point, and returns the leaves outside the window. Throws StageError for a point outside
  /// the grid, possibly after some of the calls.
  template <class Use>
  FarLeaves for_each_block(const PointColumns& points, const RigidTransform& T_target_source,
                           const Use& use) const {
    std::array<std::uint64_t, kBlock> keys{};
    if (!contains(points, T_target_source)) return one_by_one(points, T_target_source, use);
    const Instructions instructions = best_instructions();
    for (std::size_t first = 0; first < points.size(); first += kBlock) {
      const std::size_t count = std::min(kBlock, points.size() - first);
      compute_keys(points, T_target_source, first, count, instructions, keys.data());
      use(keys.data(), count);
    }
    return {};
  }

  /// Whether all points at `T_target_source` are certainly inside the window. May be false if they
  /// are near its border.
  bool contains(const PointColumns& points, const RigidTransform& T_target_source) const;

  /// Computes the keys of `count` points from the index `first`, all of which are in the window.
  void compute_keys(const PointColumns& points, const RigidTransform& T_target_source,
                    std::size_t first, std::size_t count, Instructions instructions,
                    std::uint64_t* keys) const;

 private:
  static constexpr int kWidth = 1 << 21;
  static constexpr std::uint64_t kBrickMask = (1U << 19) - 1;

  static void sort_each_once(FarLeaves& leaves);

  template <class Use>
  FarLeaves one_by_one(const PointColumns& points, const RigidTransform& T_target_source,
                       const Use& use) const {
    FarLeaves far;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Vector3i leaf = grid_.leaf_of(T_target_source * points.point(i));
      if (const std::optional<std::uint64_t> near = key_of(leaf)) {
        use(&*near, std::size_t{1});
      } else {
        far.push_back(leaf_key(leaf));
      }
    }
    sort_each_once(far);
    return far;
  }

  LeafGrid grid_;
  Eigen::Vector3i corner_;  ///< The lowest leaf of the window.
};

}  // namespace croon

#include <algorithm>
#include <cstdint>
#include <vector>

#include "framework/base/bits.hpp"
#include "framework/spatial/leaf_window.hpp"
#include "framework/stage/leaf_scorer.hpp"

namespace croon::stages::volume_scorer {
namespace {

/// Bricks of 4 x 4 x 4 leaves, one bit for each leaf, found by hashing with open addressing.
class BrickTable {
 public:
  BrickTable() { resize(kMinBits); }

  /// Occupies the leaves of `keys` (LeafWindow). The only branch in the loop that depends on the
  /// data is the search for a free slot, which seldom goes beyond the first: branch mispredictions
  /// would dominate the cost.
  void occupy(const std::uint64_t* keys, std::size_t count) {
    while (slot_count() < kSlotsPerBrick * (used_count_ + count)) grow();
    Brick* const slots = slots_.data();
    std::uint32_t* const used = used_.data();
    const int shift = shift_;
    std::size_t used_count = used_count_;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t brick_key = keys[i] >> LeafWindow::kLeafBits;
      const std::size_t slot = slot_of(brick_key, slots, shift);
      used[used_count] = static_cast<std::uint32_t>(slot);
      used_count += static_cast<std::size_t>(slots[slot].key == kNone);
      slots[slot].key = brick_key;
      slots[slot].leaves |= std::uint64_t{1} << (keys[i] % 64);
    }
    used_count_ = used_count;
  }

  std::int64_t leaves() const {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < used_count_; ++i) count += count_bits(slots_[used_[i]].leaves);
    return count;
  }

  /// Returns the number of leaves that are occupied here and not in `other`, and empties this
  /// table.
  std::int64_t take_leaves_not_in(const BrickTable& other) {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < used_count_; ++i) {
      // The other table is larger than a cache, and a misprediction is noticed only when its slot
      // arrives, so slots are prefetched well ahead.
      const std::size_t ahead = std::min(i + kAhead, used_count_ - 1);
      __builtin_prefetch(&other.slots_[first_slot(slots_[used_[ahead]].key, other.shift_)]);
      Brick& brick = slots_[used_[i]];
      const std::size_t slot = slot_of(brick.key, other.slots_.data(), other.shift_);
      count += count_bits(brick.leaves & ~other.slots_[slot].leaves);
      brick = Brick{};
    }
    begin_again();
    return count;
  }

  /// Empties the table.
  void clear() {
    for (std::size_t i = 0; i < used_count_; ++i) slots_[used_[i]] = Brick{};
    if (used_count_ > 0) begin_again();
  }

 private:
  struct Brick {
    std::uint64_t key = kNone;
    std::uint64_t leaves = 0;
  };
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  static constexpr int kMinBits = 10;
  /// Minimum number of slots per brick, so that a search seldom goes beyond its first slot. With
  /// two, a pose takes 10 to 40 % longer; with eight, large tables no longer fit the cache.
  static constexpr std::size_t kSlotsPerBrick = 4;
  static constexpr std::size_t kAhead = 16;  ///< Half or twice as many are as fast.

  std::size_t slot_count() const { return std::size_t{1} << (64 - shift_); }

  /// Fibonacci hashing (Knuth, The Art of Computer Programming, 6.4).
  static std::size_t first_slot(std::uint64_t brick_key, int shift) {
    return brick_key * 0x9e3779b97f4a7c15 >> shift;
  }

  /// Whether another brick occupies a slot. The minimum of two unsigned numbers is 0 if either is:
  /// one branch, seldom taken. With && there would be two, and which of them ends a search is
  /// unpredictable.
  static bool is_of_another(const Brick& brick, std::uint64_t brick_key) {
    return std::min(brick.key ^ brick_key, brick.key ^ kNone) != 0;
  }

  /// The slot of a brick, or the free slot where it would be inserted. A free slot has no leaves.
  static std::size_t slot_of(std::uint64_t brick_key, const Brick* slots, int shift) {
    std::size_t slot = first_slot(brick_key, shift);
    while (is_of_another(slots[slot], brick_key)) {
      slot = (slot + 1) & ((std::size_t{1} << (64 - shift)) - 1);
    }
    return slot;
  }

  /// Sets the number of slots to 2^bits; all of them must be free.
  void resize(int bits) {
    shift_ = 64 - bits;
    if (slots_.size() < slot_count()) {
      slots_.resize(slot_count());
      used_.resize(slot_count() / kSlotsPerBrick + 1);
    }
  }

  void grow() {
    moved_.clear();
    for (std::size_t i = 0; i < used_count_; ++i) {
      moved_.push_back(slots_[used_[i]]);
      slots_[used_[i]] = Brick{};
    }
    resize(64 - shift_ + 1);
    for (std::size_t i = 0; i < used_count_; ++i) {
      const std::size_t slot = slot_of(moved_[i].key, slots_.data(), shift_);
      slots_[slot] = moved_[i];
      used_[i] = static_cast<std::uint32_t>(slot);
    }
  }

  /// Resizes for about as many slots as the last pose used: the maximum so far could exceed the
  /// cache. The memory is kept.
  void begin_again() {
    int bits = kMinBits;
    while (std::size_t{1} << bits < kSlotsPerBrick * (used_count_ + LeafWindow::kBlock)) ++bits;
    used_count_ = 0;
    resize(bits);
  }

  std::vector<Brick> slots_;  ///< The first slot_count() are in use, at most a quarter occupied.
  std::vector<std::uint32_t> used_;
  std::vector<Brick> moved_;
  std::size_t used_count_ = 0;
  int shift_ = 0;
};

class BrickHash final : public LeafSet {
 public:
  static constexpr const char* kName = "brick_hash";

  BrickHash(const LeafGrid& grid, const PointColumns& target, const RigidTransform& T_grid_target)
      : window_(grid, target, T_grid_target) {
    far_ = occupy(target, T_grid_target, bricks_);
    leaves_ = bricks_.leaves() + static_cast<std::int64_t>(far_.size());
  }

  std::int64_t leaves_with(const PointColumns& source,
                           const RigidTransform& T_grid_source) const override {
    // One per thread: only the first pose allocates memory.
    thread_local BrickTable added;
    added.clear();
    const FarLeaves far = occupy(source, T_grid_source, added);
    return leaves_ + added.take_leaves_not_in(bricks_) + count_new(far, far_);
  }

 private:
  FarLeaves occupy(const PointColumns& points, const RigidTransform& T_grid_points,
                   BrickTable& bricks) const {
    return window_.for_each_block(
        points, T_grid_points,
        [&](const std::uint64_t* keys, std::size_t count) { bricks.occupy(keys, count); });
  }

  LeafWindow window_;
  BrickTable bricks_;
  FarLeaves far_;
  std::int64_t leaves_ = 0;
};

}  // namespace

StageEntry brick_hash() {
  return leaf_scorer_entry<BrickHash>(
      "Counts the bits of a hash table of bricks of 4 x 4 x 4 leaves.",
      "bricks of bits as in the leaf nodes of OpenVDB (Museth 2013), found by hashing as in "
      "Niessner et al. 2013; for the volume of CROON (arXiv 2203.03182)");
}

}  // namespace croon::stages::volume_scorer

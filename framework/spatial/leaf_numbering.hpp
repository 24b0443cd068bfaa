#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/spatial/leaf_grid.hpp"

namespace croon {

/// Numbers leaves 0, 1, 2, ... in the order in which they are first met: a hash table with open
/// addressing and linear probing (Knuth, The Art of Computer Programming, vol. 3, section 6.4).
class LeafNumbering {
 public:
  /// The number of `leaf`.
  int number_of(const LeafKey& leaf) {
    if (2 * leaves_.size() >= slots_.size()) grow();
    int& slot = slots_[slot_of(leaf)];
    if (slot == kFree) {
      slot = static_cast<int>(leaves_.size());
      leaves_.push_back(leaf);
    }
    return slot;
  }
  /// The leaves, by number.
  const std::vector<LeafKey>& leaves() const { return leaves_; }

 private:
  static constexpr int kFree = -1;

  /// The operator of arrays calls memcmp.
  static bool is_same(const LeafKey& a, const LeafKey& b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
  }

  /// The place of `leaf`, or the free place where it belongs.
  std::size_t slot_of(const LeafKey& leaf) const {
    std::uint64_t hash = 0;
    for (const int index : leaf) {
      hash = (hash ^ static_cast<std::uint32_t>(index)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 32;
    }
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = static_cast<std::size_t>(hash) & mask;
    while (slots_[slot] != kFree &&
           !is_same(leaves_[static_cast<std::size_t>(slots_[slot])], leaf)) {
      slot = (slot + 1) & mask;
    }
    return slot;
  }

  void grow() {
    constexpr std::size_t kFirstSlots = 1024;  // A power of two, like all later numbers of slots.
    slots_.assign(slots_.empty() ? kFirstSlots : 4 * slots_.size(), kFree);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
      slots_[slot_of(leaves_[i])] = static_cast<int>(i);
    }
  }

  std::vector<LeafKey> leaves_;
  std::vector<int> slots_;  ///< Numbers of leaves, or kFree; at most half are taken.
};

}  // namespace croon

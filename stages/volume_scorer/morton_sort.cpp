#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "framework/spatial/leaf_window.hpp"
#include "framework/stage/leaf_scorer.hpp"

namespace croon::stages::volume_scorer {
namespace {

/// Spreads the lowest 21 bits, with two zeros after each (Morton 1966).
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

/// The index of a leaf in Z order, the order of the leaves of an octree; each of its cubes is an
/// interval of codes.
std::uint64_t morton_code(std::uint64_t key) {
  const std::array<std::uint64_t, 3> offsets = LeafWindow::offsets(key);
  return spread(offsets[0]) | spread(offsets[1]) << 1 | spread(offsets[2]) << 2;
}

using Codes = std::vector<std::uint64_t>;

/// Radix sort by digits of 11 bits, the lowest first. Digits that all codes share are skipped.
void sort_codes(Codes& codes, Codes& buffer) {
  constexpr int kDigitBits = 11;
  constexpr std::size_t kDigits = 6;
  constexpr std::uint64_t kValues = std::uint64_t{1} << kDigitBits;
  static thread_local std::array<std::array<std::uint32_t, kValues>, kDigits> begins;
  const auto digit = [](std::uint64_t code, std::size_t d) {
    return code >> d * kDigitBits & (kValues - 1);
  };
  for (auto& counts : begins) counts.fill(0);
  for (const std::uint64_t code : codes) {
    for (std::size_t d = 0; d < kDigits; ++d) ++begins[d][digit(code, d)];
  }
  buffer.resize(codes.size());
  for (std::size_t d = 0; d < kDigits; ++d) {
    if (codes.empty() || begins[d][digit(codes[0], d)] == codes.size()) continue;
    std::uint32_t begin = 0;
    for (std::uint32_t& entry : begins[d]) {
      const std::uint32_t count = entry;
      entry = begin;
      begin += count;
    }
    for (const std::uint64_t code : codes) buffer[begins[d][digit(code, d)]++] = code;
    codes.swap(buffer);
  }
}

/// The number of distinct codes that are not in `others`; both are sorted.
std::int64_t count_new_codes(const Codes& codes, const Codes& others) {
  std::int64_t count = 0;
  auto other = others.begin();
  std::uint64_t last = ~std::uint64_t{0};
  for (const std::uint64_t code : codes) {
    if (code == last) continue;
    last = code;
    // Doubling steps: the next code is usually near, except where `others` has leaves of its own.
    auto step = std::ptrdiff_t{1};
    auto low = other;
    while (others.end() - low > step && low[step] < code) {
      low += step;
      step *= 2;
    }
    other = std::lower_bound(low, low + std::min(step + 1, others.end() - low), code);
    count += static_cast<std::int64_t>(other == others.end() || *other != code);
  }
  return count;
}

class MortonSort final : public LeafSet {
 public:
  static constexpr const char* kName = "morton_sort";

  MortonSort(const LeafGrid& grid, const PointColumns& target, const RigidTransform& T_grid_target)
      : window_(grid, target, T_grid_target) {
    far_ = sort_leaves(target, T_grid_target, codes_);
    codes_.erase(std::unique(codes_.begin(), codes_.end()), codes_.end());
  }

  std::int64_t leaves_with(const PointColumns& source,
                           const RigidTransform& T_grid_source) const override {
    // One per thread: only the first pose allocates memory.
    static thread_local Codes codes;
    const FarLeaves far = sort_leaves(source, T_grid_source, codes);
    const auto target_leaves = static_cast<std::int64_t>(codes_.size() + far_.size());
    return target_leaves + count_new_codes(codes, codes_) + count_new(far, far_);
  }

 private:
  /// Sets `codes` to the sorted code of every point's leaf; returns the leaves outside the window.
  FarLeaves sort_leaves(const PointColumns& points, const RigidTransform& T_grid_points,
                        Codes& codes) const {
    static thread_local Codes buffer;
    codes.clear();
    FarLeaves far = window_.for_each_block(
        points, T_grid_points, [&](const std::uint64_t* keys, std::size_t count) {
          std::transform(keys, keys + count, std::back_inserter(codes), morton_code);
        });
    sort_codes(codes, buffer);
    return far;
  }

  LeafWindow window_;
  Codes codes_;  ///< Distinct, sorted.
  FarLeaves far_;
};

}  // namespace

StageEntry morton_sort() {
  return leaf_scorer_entry<MortonSort>(
      "Sorts the leaves in Z order and counts the distinct ones.",
      "linear octree (Gargantini 1982) in the order of Morton 1966, for the volume of CROON (arXiv "
      "2203.03182)");
}

}  // namespace croon::stages::volume_scorer

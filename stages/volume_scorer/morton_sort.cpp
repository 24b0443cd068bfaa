#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "framework/params/values.hpp"
#include "framework/spatial/leaf_window.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon::stages::volume_scorer {
namespace {

struct Params {
  double leaf_size_m = 0.05;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::number("leaf_size_m", &Params::leaf_size_m, {1e-3, 1e3},
                     "Edge of the leaves that are counted."),
  };
  return table;
}

/// The lowest 21 bits with two zeros after each (Morton 1966).
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

/// The index of a leaf in Z order: the order of the leaves of an octree, each of whose cubes is an
/// interval of codes.
std::uint64_t morton_code(std::uint64_t key) {
  const std::array<std::uint64_t, 3> offsets = LeafWindow::offsets(key);
  return spread(offsets[0]) | spread(offsets[1]) << 1 | spread(offsets[2]) << 2;
}

using Codes = std::vector<std::uint64_t>;

/// Sorts by digits of 11 bits, the lowest first (radix sort). Digits that all codes share cost one
/// look.
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

/// How many different codes there are that `others` lacks; both are sorted.
std::int64_t count_new_codes(const Codes& codes, const Codes& others) {
  std::int64_t count = 0;
  auto other = others.begin();
  std::uint64_t last = ~std::uint64_t{0};
  for (const std::uint64_t code : codes) {
    if (code == last) continue;
    last = code;
    // Steps that double: the next one is near, unless the others have a region of their own.
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

struct Target {
  LeafWindow window;
  Codes codes;  ///< Each once, sorted.
  FarLeaves far;
};

std::shared_ptr<const Target> target_of(const Points& points, double leaf_size_m) {
  const Eigen::Vector3d middle = points.empty() ? Eigen::Vector3d::Zero().eval()
                                                : points[points.size() / 2].cast<double>().eval();
  const auto target =
      std::make_shared<Target>(Target{LeafWindow(LeafGrid(leaf_size_m), middle), {}, {}});
  Codes& codes = target->codes;
  target->far = target->window.for_each_block(
      PointColumns(points), RigidTransform{}, [&](const std::uint64_t* keys, std::size_t count) {
        std::transform(keys, keys + count, std::back_inserter(codes), morton_code);
      });
  Codes buffer;
  sort_codes(codes, buffer);
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return target;
}

class MortonSort final : public VolumeScorer {
 public:
  explicit MortonSort(const Params& params) : leaf_size_m_(params.leaf_size_m) {}

  VolumeFunction bind(std::shared_ptr<const Cloud> target,
                      std::shared_ptr<const Cloud> source) const override {
    const auto bound =
        target->once<Target>("volume_scorer/morton_sort", params::value_json(leaf_size_m_),
                             [&] { return target_of(target->points(), leaf_size_m_); });
    const auto points = source->once<PointColumns>(
        "volume_scorer/columns", [&] { return std::make_shared<PointColumns>(source->points()); });
    return {[bound, points, leaf_size_m = leaf_size_m_](const RigidTransform& T_target_source) {
              // One per thread: no pose allocates memory after the first.
              static thread_local Codes codes, buffer;
              codes.clear();
              const FarLeaves far = bound->window.for_each_block(
                  *points, T_target_source, [&](const std::uint64_t* keys, std::size_t count) {
                    std::transform(keys, keys + count, std::back_inserter(codes), morton_code);
                  });
              sort_codes(codes, buffer);
              const auto target_leaves =
                  static_cast<std::int64_t>(bound->codes.size() + bound->far.size());
              return OccupiedVolume{
                  target_leaves + count_new_codes(codes, bound->codes) + count_new(far, bound->far),
                  leaf_size_m};
            },
            Poses::in_parallel};
  }

 private:
  double leaf_size_m_;
};

}  // namespace

StageEntry morton_sort() {
  return stage_entry<MortonSort>(
      "morton_sort", "Sorts the leaves in Z order and counts the different ones.",
      "linear octree (Gargantini 1982) in the order of Morton 1966, for the volume of CROON (arXiv "
      "2203.03182)",
      table());
}

}  // namespace croon::stages::volume_scorer

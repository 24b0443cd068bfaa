#include "experiments/statistics/bootstrap.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "experiments/engine/threads.hpp"
#include "framework/base/rng.hpp"

namespace croon::experiments {

namespace {

/// Resamples that share a stream of random numbers; to seed one costs as much as some hundred
/// draws.
constexpr std::size_t kBlock = 50;

/// One side of the pairs, in ascending order.
struct SortedSide {
  std::vector<double> values;
  std::vector<std::size_t> pairs;  ///< Which pair each value is of.
};

SortedSide sorted_side(const std::vector<double>& values) {
  SortedSide side;
  side.pairs.resize(values.size());
  std::iota(side.pairs.begin(), side.pairs.end(), std::size_t{0});
  std::sort(side.pairs.begin(), side.pairs.end(), [&](std::size_t a, std::size_t b) {
    return values[a] != values[b] ? values[a] < values[b] : a < b;
  });
  for (const std::size_t pair : side.pairs) side.values.push_back(values[pair]);
  return side;
}

/// The median of a resample that has pair i `counts[i]` times, `counts.size()` in all.
double median_of(const SortedSide& side, const std::vector<std::uint32_t>& counts) {
  const std::size_t n = counts.size();
  std::size_t place = 0;
  std::size_t passed = counts[side.pairs[0]];
  while (passed <= (n - 1) / 2) passed += counts[side.pairs[++place]];
  const double lower = side.values[place];
  while (passed <= n / 2) passed += counts[side.pairs[++place]];
  return lower == side.values[place] ? lower : 0.5 * (lower + side.values[place]);
}

void draw(Rng& rng, std::vector<std::uint32_t>& counts) {
  std::fill(counts.begin(), counts.end(), 0U);
  const auto n = static_cast<double>(counts.size());
  // Below n even after rounding, and 53 bits leave no bias; `below` would take twice as long.
  for (std::size_t i = 0; i < counts.size(); ++i) {
    ++counts[static_cast<std::size_t>(rng.uniform() * n)];
  }
}

/// The difference of medians in each resample.
std::vector<double> resampled_differences(const SortedSide& base, const SortedSide& variant) {
  const std::size_t n = base.values.size();
  std::vector<double> all(std::clamp<std::size_t>(20000000 / n, 200, 2000));
  const std::size_t blocks = (all.size() + kBlock - 1) / kBlock;
  for_each_in_parallel(blocks, [&](std::size_t block) {
    Rng rng(StreamKey(0).with("bootstrap").with(block));
    std::vector<std::uint32_t> counts(n);
    for (std::size_t i = block * kBlock; i < std::min(all.size(), (block + 1) * kBlock); ++i) {
      draw(rng, counts);
      all[i] = difference(median_of(variant, counts), median_of(base, counts));
    }
  });
  return all;
}

}  // namespace

Interval median_difference_interval(const Pairs& pairs) {
  if (pairs.base.empty()) throw std::logic_error("a bootstrap of no pairs");
  std::vector<double> all =
      resampled_differences(sorted_side(pairs.base), sorted_side(pairs.variant));
  std::sort(all.begin(), all.end());
  // Order statistics, not between them: an end may be infinite.
  const std::size_t low = all.size() / 40 - 1;
  return {all[low], all[all.size() - 1 - low]};
}

}  // namespace croon::experiments

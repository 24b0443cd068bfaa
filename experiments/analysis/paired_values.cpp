#include "experiments/analysis/paired_values.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include "framework/base/rng.hpp"
#include "framework/base/threads.hpp"

namespace croon::experiments {

namespace {

/// Resamples that share a stream of random numbers; seeding a stream costs as much as some hundred
/// draws.
constexpr std::size_t kBlock = 50;

/// One side of the pairs, in ascending order.
struct SortedSide {
  std::vector<double> values;
  std::vector<std::size_t> pairs;  ///< The index of the pair that each value is from.
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

/// The pairs of each cluster.
using Members = std::vector<std::vector<std::size_t>>;

Members members_of(const std::vector<std::size_t>& clusters) {
  Members members;
  for (std::size_t pair = 0; pair < clusters.size(); ++pair) {
    if (clusters[pair] >= members.size()) members.resize(clusters[pair] + 1);
    members[clusters[pair]].push_back(pair);
  }
  const auto is_empty = [](const std::vector<std::size_t>& pairs) { return pairs.empty(); };
  members.erase(std::remove_if(members.begin(), members.end(), is_empty), members.end());
  return members;
}

/// The number of times that a resample has each pair.
struct Resample {
  std::vector<std::uint32_t> counts;
  std::size_t size = 0;
};

/// The median of the pairs of a resample.
double median_of(const SortedSide& side, const Resample& drawn) {
  std::size_t index = 0;
  std::size_t passed = drawn.counts[side.pairs[0]];
  while (passed <= (drawn.size - 1) / 2) passed += drawn.counts[side.pairs[++index]];
  const double lower = side.values[index];
  while (passed <= drawn.size / 2) passed += drawn.counts[side.pairs[++index]];
  return lower == side.values[index] ? lower : 0.5 * (lower + side.values[index]);
}

/// Below `n` even after rounding, and 53 bits leave no bias; `Rng::below` would take twice as long.
std::size_t draw_below(Rng& rng, std::size_t n) {
  return static_cast<std::size_t>(rng.uniform() * static_cast<double>(n));
}

void draw(Rng& rng, const Members& members, Resample& drawn) {
  std::fill(drawn.counts.begin(), drawn.counts.end(), 0U);
  drawn.size = 0;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::vector<std::size_t>& cluster = members[draw_below(rng, members.size())];
    for (std::size_t k = 0; k < cluster.size(); ++k) {
      ++drawn.counts[cluster[draw_below(rng, cluster.size())]];
    }
    drawn.size += cluster.size();
  }
}

/// The difference of medians in each resample.
std::vector<double> resampled_differences(const SortedSide& base, const SortedSide& variant,
                                          const Members& members) {
  const std::size_t n = base.values.size();
  std::vector<double> all(std::clamp<std::size_t>(20000000 / n, 200, 2000));
  const std::size_t blocks = (all.size() + kBlock - 1) / kBlock;
  for_each_in_parallel(blocks, [&](std::size_t block) {
    Rng rng(StreamKey(0).with("bootstrap").with(block));
    Resample drawn;
    drawn.counts.resize(n);
    for (std::size_t i = block * kBlock; i < std::min(all.size(), (block + 1) * kBlock); ++i) {
      draw(rng, members, drawn);
      all[i] = difference(median_of(variant, drawn), median_of(base, drawn));
    }
  });
  return all;
}

}  // namespace

double difference(double variant, double base) { return variant == base ? 0.0 : variant - base; }

std::vector<double> differences(const Pairs& pairs) {
  std::vector<double> all;
  all.reserve(pairs.base.size());
  for (std::size_t i = 0; i < pairs.base.size(); ++i) {
    all.push_back(difference(pairs.variant[i], pairs.base[i]));
  }
  return all;
}

double median_with_failures(std::vector<double> values) {
  if (values.empty()) throw std::logic_error("a median of no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*std::max_element(values.begin(), middle) + *middle);
}

Interval median_difference_interval(const Pairs& pairs, const std::vector<std::size_t>& clusters) {
  if (pairs.base.empty()) throw std::logic_error("a bootstrap of no pairs");
  std::vector<double> all = resampled_differences(sorted_side(pairs.base),
                                                  sorted_side(pairs.variant), members_of(clusters));
  std::sort(all.begin(), all.end());
  // Order statistics, not between them: an end may be infinite.
  const std::size_t low = all.size() / 40 - 1;
  return {all[low], all[all.size() - 1 - low]};
}

}  // namespace croon::experiments

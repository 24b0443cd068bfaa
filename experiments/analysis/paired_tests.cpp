#include "experiments/analysis/paired_tests.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "framework/base/rng.hpp"
#include "framework/base/threads.hpp"

namespace croon::experiments {
namespace {

/// The maximum number of ranks for Wilcoxon's exact test; for more, the normal approximation is off
/// by less than 0.01.
constexpr std::size_t kMaxExactRanks = 25;

/// The maximum number of sums for the exact sign-flip test: 2^16 signs take a fraction of a
/// millisecond.
constexpr std::size_t kMaxExactSums = 16;

/// The number of resamples per stream of random numbers; seeding a stream costs as much as some
/// hundred draws.
constexpr std::size_t kBlock = 50;

/// The indices of `values` in ascending order of the values; equal values by index.
std::vector<std::size_t> ascending(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

/// The indices of the pairs of each non-empty cluster.
using Members = std::vector<std::vector<std::size_t>>;

Members members_of(const Clusters& clusters) {
  std::map<std::size_t, std::vector<std::size_t>> by_cluster;
  for (std::size_t i = 0; i < clusters.size(); ++i) by_cluster[clusters[i]].push_back(i);
  Members members;
  for (const auto& [cluster, pairs] : by_cluster) members.push_back(pairs);
  return members;
}

/// How often a resample contains each pair.
struct Resample {
  std::vector<std::uint32_t> counts;
  std::size_t size = 0;
};

/// The mean of the two middle values of a median. Halfway between -inf and inf, a failure of either
/// side, is no difference: 0.
double halfway(double lower, double upper) {
  if (lower == upper) return lower;
  return std::isinf(lower) && std::isinf(upper) ? 0.0 : 0.5 * (lower + upper);
}

/// The median of one side of the pairs of a resample; `order` sorts `values` in ascending order.
double median_of(const std::vector<double>& values, const std::vector<std::size_t>& order,
                 const Resample& drawn) {
  std::size_t index = 0;
  std::size_t passed = drawn.counts[order[0]];
  while (passed <= (drawn.size - 1) / 2) passed += drawn.counts[order[++index]];
  const double lower = values[order[index]];
  while (passed <= drawn.size / 2) passed += drawn.counts[order[++index]];
  const double upper = values[order[index]];
  return halfway(lower, upper);
}

/// Below `n` even after rounding; the bias of 53 bits is negligible. `Rng::below` would take twice
/// as long.
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

/// The share of all sign combinations of `magnitudes` whose sum is at least as far from 0 as `sum`;
/// both are doubled, so that mean ranks are whole numbers.
double exact_p(const std::vector<long long>& magnitudes, long long sum) {
  std::map<long long, double> ways = {{0, 1.0}};  // Number of sign combinations by sum.
  for (const long long magnitude : magnitudes) {
    std::map<long long, double> longer;
    for (const auto& [shorter_sum, count] : ways) {
      longer[shorter_sum + magnitude] += count;
      longer[shorter_sum - magnitude] += count;
    }
    ways = std::move(longer);
  }
  double extreme = 0.0;
  for (const auto& [signed_sum, count] : ways) {
    if (std::abs(signed_sum) >= std::abs(sum)) extreme += count;
  }
  return std::ldexp(extreme, -static_cast<int>(magnitudes.size()));
}

/// The number of sign combinations, from `from` on, for which `sum` ends at least as far from 0 as
/// `bound`.
double count_extreme(const std::vector<double>& sums, std::size_t from, double sum, double bound) {
  if (from == sums.size()) return std::abs(sum) >= bound ? 1.0 : 0.0;
  return count_extreme(sums, from + 1, sum + sums[from], bound) +
         count_extreme(sums, from + 1, sum - sums[from], bound);
}

}  // namespace

double difference(double variant, double base) { return variant == base ? 0.0 : variant - base; }

std::vector<double> differences(const Pairs& pairs) {
  std::vector<double> all(pairs.base.size());
  std::transform(pairs.variant.begin(), pairs.variant.end(), pairs.base.begin(), all.begin(),
                 difference);
  return all;
}

double median_with_failures(std::vector<double> values) {
  if (values.empty()) throw std::logic_error("median of no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return halfway(*std::max_element(values.begin(), middle), *middle);
}

Interval median_difference_interval(const Pairs& pairs, const Clusters& clusters) {
  const std::size_t n = pairs.base.size();
  if (n == 0) throw std::logic_error("bootstrap of no pairs");
  const std::vector<std::size_t> base = ascending(pairs.base);
  const std::vector<std::size_t> variant = ascending(pairs.variant);
  const Members members = members_of(clusters);
  std::vector<double> all(std::clamp<std::size_t>(20000000 / n, 200, 2000));
  for_each_in_parallel((all.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    Rng rng(StreamKey(0).with("bootstrap").with(block));
    Resample drawn{std::vector<std::uint32_t>(n)};
    for (std::size_t i = block * kBlock; i < std::min(all.size(), (block + 1) * kBlock); ++i) {
      draw(rng, members, drawn);
      all[i] =
          difference(median_of(pairs.variant, variant, drawn), median_of(pairs.base, base, drawn));
    }
  });
  std::sort(all.begin(), all.end());
  // Order statistics without interpolation, because an end may be infinite.
  const std::size_t low = all.size() / 40 - 1;
  return {all[low], all[all.size() - 1 - low]};
}

double mcnemar_p(int only_base, int only_variant) {
  if (only_base < 0 || only_variant < 0) throw std::logic_error("negative number of pairs");
  if (only_base == only_variant) return 1.0;
  const double trials = static_cast<double>(only_base) + only_variant;
  const boost::math::binomial lesser(trials, 0.5);
  return std::min(1.0, 2.0 * boost::math::cdf(lesser, std::min(only_base, only_variant)));
}

std::vector<double> signed_ranks(const std::vector<double>& differences) {
  std::vector<double> magnitudes;
  for (const double value : differences) magnitudes.push_back(std::abs(value));
  const std::vector<std::size_t> order = ascending(magnitudes);
  std::vector<double> ranks(differences.size(), 0.0);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && magnitudes[order[end]] == magnitudes[order[begin]]) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    for (std::size_t k = begin; k < end; ++k) {
      const double value = differences[order[k]];
      if (value != 0.0) ranks[order[k]] = value > 0.0 ? rank : -rank;
    }
  }
  return ranks;
}

double wilcoxon_p(const std::vector<double>& ranks) {
  std::vector<long long> magnitudes;
  long long sum = 0;
  for (const double rank : ranks) {
    if (rank == 0.0) continue;
    if (magnitudes.size() == kMaxExactRanks) return normal_sign_p(ranks);
    magnitudes.push_back(std::llround(2.0 * std::abs(rank)));
    sum += std::llround(2.0 * rank);
  }
  return magnitudes.empty() ? 1.0 : exact_p(magnitudes, sum);
}

std::vector<double> cluster_sums(const std::vector<double>& scores, const Clusters& clusters) {
  std::vector<double> sums;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (clusters[i] >= sums.size()) sums.resize(clusters[i] + 1, 0.0);
    sums[clusters[i]] += scores[i];
  }
  return sums;
}

double normal_sign_p(const std::vector<double>& scores) {
  double sum = 0.0;
  double squares = 0.0;
  double min_step = std::numeric_limits<double>::infinity();
  for (const double score : scores) {
    sum += score;
    squares += score * score;
    if (score != 0.0) min_step = std::min(min_step, std::abs(score));
  }
  if (squares == 0.0) return 1.0;
  const double z = std::max(0.0, std::abs(sum) - min_step) / std::sqrt(squares);
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

double sign_flip_p(const std::vector<double>& sums) {
  std::vector<double> flipped;
  std::copy_if(sums.begin(), sums.end(), std::back_inserter(flipped),
               [](double sum) { return sum != 0.0; });
  if (flipped.empty()) return 1.0;
  if (flipped.size() > kMaxExactSums) return normal_sign_p(flipped);
  const double observed = std::abs(std::accumulate(flipped.begin(), flipped.end(), 0.0));
  // Flipping all signs gives the same |sum|, so the first sign can stay fixed.
  const double extreme = count_extreme(flipped, 1, flipped.front(), observed);
  return std::ldexp(extreme, 1 - static_cast<int>(flipped.size()));
}

std::vector<double> holm(const std::vector<double>& p_values) {
  const std::vector<std::size_t> order = ascending(p_values);
  std::vector<double> corrected(p_values.size());
  double max_p = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto left = static_cast<double>(order.size() - i);
    max_p = std::max(max_p, std::min(1.0, left * p_values[order[i]]));
    corrected[order[i]] = max_p;
  }
  return corrected;
}

}  // namespace croon::experiments

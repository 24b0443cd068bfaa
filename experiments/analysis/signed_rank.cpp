#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "experiments/analysis/paired_tests.hpp"

namespace croon::experiments {

namespace {

/// Exact up to here; beyond, the normal distribution is off by less than 0.01.
constexpr std::size_t kMostExact = 25;

/// `ways[count][excess]`: how many subsets of `magnitudes` have so many members that exceed
/// `least` by so much in sum. Two indices keep the table small where zeros lift every rank.
std::vector<std::vector<double>> count_subsets(const std::vector<long long>& magnitudes,
                                               long long least) {
  std::size_t most = 0;
  for (const long long magnitude : magnitudes) most += static_cast<std::size_t>(magnitude - least);
  std::vector<std::vector<double>> ways(magnitudes.size() + 1, std::vector<double>(most + 1, 0.0));
  ways[0][0] = 1.0;
  for (std::size_t i = 0; i < magnitudes.size(); ++i) {
    const auto step = static_cast<std::size_t>(magnitudes[i] - least);
    for (std::size_t count = i + 1; count > 0; --count) {
      for (std::size_t excess = step; excess <= most; ++excess) {
        ways[count][excess] += ways[count - 1][excess - step];
      }
    }
  }
  return ways;
}

/// The share of all signs that bring the sum at least as far from 0 as `sum`; both are doubled, so
/// that mean ranks are whole numbers.
double exact_p(const std::vector<long long>& magnitudes, long long sum) {
  const long long least = *std::min_element(magnitudes.begin(), magnitudes.end());
  const long long total = std::accumulate(magnitudes.begin(), magnitudes.end(), 0LL);
  const auto ways = count_subsets(magnitudes, least);
  double extreme = 0.0;
  for (std::size_t count = 0; count < ways.size(); ++count) {
    for (std::size_t excess = 0; excess < ways[count].size(); ++excess) {
      const auto positive = static_cast<long long>(count) * least + static_cast<long long>(excess);
      if (std::abs(2 * positive - total) >= std::abs(sum)) extreme += ways[count][excess];
    }
  }
  return std::ldexp(extreme, -static_cast<int>(magnitudes.size()));
}

}  // namespace

std::vector<double> signed_ranks(const std::vector<double>& differences) {
  const auto magnitude = [&](std::size_t i) { return std::abs(differences[i]); };
  std::vector<std::size_t> order(differences.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return magnitude(a) < magnitude(b); });
  std::vector<double> ranks(differences.size(), 0.0);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    while (end < order.size() && magnitude(order[end]) == magnitude(order[begin])) ++end;
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
    if (magnitudes.size() == kMostExact) return normal_sign_p(ranks);
    magnitudes.push_back(std::llround(2.0 * std::abs(rank)));
    sum += std::llround(2.0 * rank);
  }
  return magnitudes.empty() ? 1.0 : exact_p(magnitudes, sum);
}

}  // namespace croon::experiments

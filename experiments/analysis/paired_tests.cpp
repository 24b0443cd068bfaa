#include "experiments/analysis/paired_tests.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace croon::experiments {

namespace {

/// 2^16 sums take a fraction of a millisecond.
constexpr std::size_t kMostExact = 16;

/// How many of the signs from `from` on bring `sum` at least as far from 0 as `bound`.
double count_extreme(const std::vector<double>& sums, std::size_t from, double sum, double bound) {
  if (from == sums.size()) return std::abs(sum) >= bound ? 1.0 : 0.0;
  return count_extreme(sums, from + 1, sum + sums[from], bound) +
         count_extreme(sums, from + 1, sum - sums[from], bound);
}

}  // namespace

double mcnemar_p(int only_base, int only_variant) {
  if (only_base < 0 || only_variant < 0) throw std::logic_error("a negative number of pairs");
  if (only_base == only_variant) return 1.0;
  const double trials = static_cast<double>(only_base) + only_variant;
  const boost::math::binomial lesser(trials, 0.5);
  return std::min(1.0, 2.0 * boost::math::cdf(lesser, std::min(only_base, only_variant)));
}

std::vector<double> cluster_sums(const std::vector<double>& scores,
                                 const std::vector<std::size_t>& clusters) {
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
  double least = std::numeric_limits<double>::infinity();
  for (const double score : scores) {
    sum += score;
    squares += score * score;
    if (score != 0.0) least = std::min(least, std::abs(score));
  }
  if (squares == 0.0) return 1.0;
  const double z = std::max(0.0, std::abs(sum) - least) / std::sqrt(squares);
  return 2.0 * boost::math::cdf(boost::math::complement(boost::math::normal(), z));
}

double sign_flip_p(const std::vector<double>& sums) {
  std::vector<double> flipped;
  std::copy_if(sums.begin(), sums.end(), std::back_inserter(flipped),
               [](double sum) { return sum != 0.0; });
  if (flipped.empty()) return 1.0;
  if (flipped.size() > kMostExact) return normal_sign_p(flipped);
  const double observed = std::abs(std::accumulate(flipped.begin(), flipped.end(), 0.0));
  // All signs turned round give the same |sum|, so the first may keep its own.
  const double extreme = count_extreme(flipped, 1, flipped.front(), observed);
  return std::ldexp(extreme, 1 - static_cast<int>(flipped.size()));
}

std::vector<double> holm(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return p_values[a] < p_values[b]; });
  std::vector<double> corrected(p_values.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto left = static_cast<double>(order.size() - i);
    largest = std::max(largest, std::min(1.0, left * p_values[order[i]]));
    corrected[order[i]] = largest;
  }
  return corrected;
}

}  // namespace croon::experiments

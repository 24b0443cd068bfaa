#pragma once

#include <cstddef>
#include <vector>

#include "experiments/statistics/pairs.hpp"
#include "framework/base/statistics.hpp"

namespace croon::experiments {

/// The 95 % percentile bootstrap interval (Efron and Tibshirani 1993, chapter 13) of
/// `median(variant) - median(base)`, drawn anew 2e7 / n times within [200, 2000]. `clusters[i]` in
/// {0, 1, ...} is that of pair i: clusters are drawn anew, and in each drawn one its pairs, for
/// pairs of one cluster are alike (Davison and Hinkley 1997, section 3.8). Medians are over all
/// trials, failures as +infinity, so an end may be infinite; where both medians are infinite the
/// difference is 0. The same bits for the same pairs in the same order. Throws std::logic_error
/// where there are no pairs.
Interval median_difference_interval(const Pairs& pairs, const std::vector<std::size_t>& clusters);

}  // namespace croon::experiments

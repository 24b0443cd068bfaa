#pragma once

#include <cstddef>
#include <vector>

#include "framework/base/statistics.hpp"

namespace croon::experiments {

/// The errors of two variants in the same trials; the i-th of both belong together. The error of a
/// trial without a usable result is +infinity.
struct Pairs {
  std::vector<double> base;
  std::vector<double> variant;
};

/// `variant - base`; 0 if both are infinite, for then neither is better.
double difference(double variant, double base);

/// The differences of all pairs.
std::vector<double> differences(const Pairs& pairs);

/// The middle value, or the mean of the middle two, of values that may be infinite. Throws
/// std::logic_error if there are none.
double median_with_failures(std::vector<double> values);

/// The 95 % percentile bootstrap interval (Efron and Tibshirani 1993, chapter 13) of
/// `median(variant) - median(base)`, from 2e7 / n resamples within [200, 2000]. `clusters[i]` in
/// {0, 1, ...} is the cluster of pair i. Clusters are resampled, and within each its pairs, because
/// pairs of one cluster are alike (Davison and Hinkley 1997, section 3.8). Medians are over all
/// trials, failures as +infinity, so an end may be infinite; if both medians are infinite the
/// difference is 0. The same bits for the same pairs in the same order. Throws std::logic_error if
/// there are no pairs.
Interval median_difference_interval(const Pairs& pairs, const std::vector<std::size_t>& clusters);

}  // namespace croon::experiments

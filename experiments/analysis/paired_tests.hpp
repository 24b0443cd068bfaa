#pragma once

#include <cstddef>
#include <vector>

#include "framework/base/statistics.hpp"

namespace croon::experiments {

/// The errors of two variants in the same trials, paired by index. The error of a trial without a
/// usable result is +infinity.
struct Pairs {
  std::vector<double> base;
  std::vector<double> variant;
};

/// The cluster of each pair or score, numbered from 0: trials of one scene are dependent.
using Clusters = std::vector<std::size_t>;

/// `variant - base`; 0 if both are infinite, because neither is better.
double difference(double variant, double base);

/// The differences of all pairs.
std::vector<double> differences(const Pairs& pairs);

/// The median of values that may be infinite: the middle value, or the mean of the middle two.
/// Throws std::logic_error if there are no values.
double median_with_failures(std::vector<double> values);

/// The 95 % percentile bootstrap interval (Efron and Tibshirani 1993, chapter 13) of
/// `median(variant) - median(base)`, from 2e7 / n resamples, clamped to [200, 2000]. Clusters are
/// resampled, and the pairs within each cluster, because pairs of one cluster are dependent
/// (Davison and Hinkley 1997, section 3.8). Medians are over all trials, with failures as
/// +infinity, so an end may be infinite; if both medians are infinite the difference is 0. Returns
/// the same bits for the same pairs in the same order. Throws std::logic_error if there are no
/// pairs.
Interval median_difference_interval(const Pairs& pairs, const Clusters& clusters);

/// The exact two-sided p of McNemar's test (1947): under its hypothesis, in a pair with only one
/// success either side is equally likely to be the successful one, so the smaller number is
/// binomial. 1 if both are 0. Throws std::logic_error if a number is negative.
double mcnemar_p(int only_base, int only_variant);

/// The signed ranks of paired differences: the rank of each magnitude among all (the mean rank for
/// ties), with the sign of the difference. Zeros occupy the lowest ranks and score 0 (Pratt 1959).
/// An infinite difference ranks above every number.
std::vector<double> signed_ranks(const std::vector<double>& differences);

/// The two-sided p of the signed-rank test (Wilcoxon 1945), whose hypothesis is that each rank has
/// either sign with equal probability. Exact for up to 25 nonzero scores, also with ties and zeros;
/// for more it is `normal_sign_p`. 1 if all are 0.
double wilcoxon_p(const std::vector<double>& ranks);

/// The sum of the scores of each cluster; 0 for a cluster without scores.
std::vector<double> cluster_sums(const std::vector<double>& scores, const Clusters& clusters);

/// The two-sided p of the sum of `scores`, if each has either sign with equal probability, by the
/// normal approximation: `z = (|S| - c) / sqrt(sum s_i^2)`. The continuity correction `c` is the
/// minimum nonzero |s_i|: 1 for ranks without ties, half a step of the sum. If zeros occupy the
/// lowest ranks it is larger, and p conservative. 1 if all are 0.
double normal_sign_p(const std::vector<double>& scores);

/// The two-sided p of scores that are independent between clusters only: each cluster's sum has
/// either sign with equal probability. With signed ranks this is the clustered signed-rank test
/// (Rosner, Glynn and Lee 2006); with differences of success (1, 0 and -1) the clustered test of
/// McNemar (Obuchowski 1998; Durkalski et al. 2003). Exact, over all signs, for up to 16 nonzero
/// sums; for more it is `normal_sign_p`. Scores are multiples of a half, so that sums are exact.
double sign_flip_p(const std::vector<double>& sums);

/// The p values corrected for multiple testing by Holm's step-down procedure (1979), in their
/// order. If all hypotheses with values below 0.05 are rejected, the probability of any false
/// rejection is at most 5 %.
std::vector<double> holm(const std::vector<double>& p_values);

}  // namespace croon::experiments

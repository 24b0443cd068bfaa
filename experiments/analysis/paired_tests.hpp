#pragma once

#include <cstddef>
#include <vector>

namespace croon::experiments {

/// The exact two-sided p of McNemar's test (1947): of the pairs that one side alone won, each side
/// won either with equal chance, so the lesser number is binomial. 1 if there are none. Throws
/// std::logic_error if a number is negative.
double mcnemar_p(int only_base, int only_variant);

/// The signed ranks of paired differences: the rank of each magnitude among all, the mean rank if
/// some are equal, with the sign of the difference. Zeros take the lowest ranks and score 0
/// (Pratt 1959). An infinite difference ranks above every number.
std::vector<double> signed_ranks(const std::vector<double>& differences);

/// The two-sided p of the signed-rank test (Wilcoxon 1945), whose hypothesis is that each rank has
/// either sign with equal chance. Exact for up to 25 scores that are not 0, also with ties and
/// zeros; for more it is `normal_sign_p`. 1 if all are 0.
double wilcoxon_p(const std::vector<double>& ranks);

/// The sums of the scores of each cluster; `clusters[i]` in {0, 1, ...} is that of `scores[i]`.
std::vector<double> cluster_sums(const std::vector<double>& scores,
                                 const std::vector<std::size_t>& clusters);

/// The two-sided p of the sum of `scores`, if each has either sign with equal chance, by the normal
/// distribution: `z = (|S| - c) / sqrt(sum s_i^2)`. The continuity correction `c` is the least
/// |s_i| that is not 0: 1 for ranks without ties, half a step of the sum; if zeros took the lowest
/// ranks it is more, and p too large. 1 if all are 0.
double normal_sign_p(const std::vector<double>& scores);

/// The two-sided p of scores that are independent between clusters only, each cluster's sum with
/// either sign with equal chance. With signed ranks it is the clustered signed-rank test (Rosner,
/// Glynn and Lee 2006); with differences of success, 1, 0 and -1, the clustered test of McNemar
/// (Obuchowski 1998; Durkalski et al. 2003). Exact, over all signs, for up to 16 sums that are not
/// 0; for more it is `normal_sign_p`. Scores are multiples of a half, so that sums are exact.
double sign_flip_p(const std::vector<double>& sums);

/// The p values corrected for their number by Holm's step-down procedure (1979), in their order:
/// those below 0.05 hold together, with a chance of at most 5 % that any of them is false.
std::vector<double> holm(const std::vector<double>& p_values);

}  // namespace croon::experiments

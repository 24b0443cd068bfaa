#pragma once

#include <cstddef>
#include <vector>

namespace croon::experiments {

/// The sums of the scores of each cluster; `clusters[i]` in {0, 1, ...} is that of `scores[i]`.
std::vector<double> cluster_sums(const std::vector<double>& scores,
                                 const std::vector<std::size_t>& clusters);

/// The two-sided p of the sum of `scores`, had each either sign with equal chance, by the normal
/// distribution: `z = (|S| - c) / sqrt(sum s_i^2)`. The correction for continuity `c` is the least
/// |s_i| that is not 0: 1 for ranks without ties, half of a step of the sum; where zeros took the
/// lowest ranks it is more, and p too large. 1 where all are 0.
double normal_sign_p(const std::vector<double>& scores);

/// The two-sided p of scores that are independent between clusters only, each cluster's sum with
/// either sign with equal chance. With signed ranks it is the clustered signed-rank test (Rosner,
/// Glynn and Lee 2006); with differences of success, 1, 0 and -1, the clustered test of McNemar
/// (Obuchowski 1998; Durkalski et al. 2003). Exact, over all signs, of up to 16 sums that are not
/// 0; of more it is `normal_sign_p`. Scores are multiples of a half, so that sums are exact.
double sign_flip_p(const std::vector<double>& sums);

}  // namespace croon::experiments

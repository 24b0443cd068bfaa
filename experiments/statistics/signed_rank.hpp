#pragma once

#include <vector>

namespace croon::experiments {

/// The signed ranks of paired differences: the rank of each magnitude among all, the mean rank
/// where some are equal, with the sign of the difference. Zeros take the lowest ranks and score 0
/// (Pratt 1959). An infinite difference ranks above every number.
std::vector<double> signed_ranks(const std::vector<double>& differences);

/// The two-sided p of the signed-rank test (Wilcoxon 1945), whose hypothesis is that each rank has
/// either sign with equal chance. Of up to 25 scores that are not 0 it is exact, also with ties and
/// zeros; of more it is `normal_sign_p`. 1 where all are 0.
double wilcoxon_p(const std::vector<double>& ranks);

}  // namespace croon::experiments

#pragma once

#include <vector>

namespace croon::experiments {

/// The p values corrected for their number by Holm's step-down procedure (1979), in their order:
/// those below 0.05 hold together, with a chance of 5 % at most that any of them is false.
std::vector<double> holm(const std::vector<double>& p_values);

}  // namespace croon::experiments

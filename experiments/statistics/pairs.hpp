#pragma once

#include <vector>

namespace croon::experiments {

/// What two variants came to in the same trials; the i-th of both belong together. A trial without
/// a usable result is +infinity.
struct Pairs {
  std::vector<double> base;
  std::vector<double> variant;
};

/// `variant - base`; 0 where both are infinite, for then neither is better.
double difference(double variant, double base);

/// The differences of all pairs.
std::vector<double> differences(const Pairs& pairs);

/// The middle value, or the mean of the middle two, of values that may be infinite. Throws
/// std::logic_error where there are none.
double median_with_failures(std::vector<double> values);

}  // namespace croon::experiments

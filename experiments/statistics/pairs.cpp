#include "experiments/statistics/pairs.hpp"

#include <algorithm>
#include <stdexcept>

namespace croon::experiments {

double difference(double variant, double base) { return variant == base ? 0.0 : variant - base; }

std::vector<double> differences(const Pairs& pairs) {
  std::vector<double> all;
  all.reserve(pairs.base.size());
  for (std::size_t i = 0; i < pairs.base.size(); ++i) {
    all.push_back(difference(pairs.variant[i], pairs.base[i]));
  }
  return all;
}

double median_with_failures(std::vector<double> values) {
  if (values.empty()) throw std::logic_error("a median of no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*std::max_element(values.begin(), middle) + *middle);
}

}  // namespace croon::experiments

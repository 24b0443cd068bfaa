#include "experiments/statistics/mcnemar.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <stdexcept>

namespace croon::experiments {

double mcnemar_p(int only_base, int only_variant) {
  if (only_base < 0 || only_variant < 0) throw std::logic_error("a negative number of pairs");
  if (only_base == only_variant) return 1.0;
  const double trials = static_cast<double>(only_base) + only_variant;
  const boost::math::binomial lesser(trials, 0.5);
  return std::min(1.0, 2.0 * boost::math::cdf(lesser, std::min(only_base, only_variant)));
}

}  // namespace croon::experiments

#include "experiments/file/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace croon::experiments {

double p95_of_magnitudes(const std::vector<double>& values) {
  std::vector<double> magnitudes(values.size());
  std::transform(values.begin(), values.end(), magnitudes.begin(),
                 [](double value) { return std::abs(value); });
  return percentile(std::move(magnitudes), 0.95);
}

Statistics statistics_of(const std::vector<double>& values) {
  Statistics statistics;
  for (std::size_t k = 0; k < kStatistics.size(); ++k) {
    statistics[k] = values.size() < kStatistics[k].min_values
                        ? std::numeric_limits<double>::quiet_NaN()
                        : kStatistics[k].function(values);
  }
  return statistics;
}

std::vector<std::string> statistic_names() {
  std::vector<std::string> names;
  for (const Statistic& statistic : kStatistics) names.emplace_back(statistic.name);
  return names;
}

}  // namespace croon::experiments

#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/statistics.hpp"

namespace croon::experiments {

/// A statistic of the deviations of trials, for one measure.
struct Statistic {
  const char* name;  ///< As in files and claims.
  double (*function)(const std::vector<double>& values);
  std::size_t min_values;  ///< NaN for fewer values.
  /// False if also meaningful without ground truth, where deviations are from the consensus of the
  /// trials: their mean is zero for every method.
  bool needs_truth;
  bool is_signed;  ///< Otherwise never negative.
};

/// The 95th percentile of the absolute values.
double p95_of_magnitudes(const std::vector<double>& values);

/// The statistics in the order of the files. The only list of them: a new statistic is a row here;
/// summary.csv, summary.json, summary_by_kind.csv, loops.csv and claims are derived from it.
inline constexpr std::array kStatistics = {
    Statistic{"mean", mean, 1, true, true},
    Statistic{"std", standard_deviation, 2, false, false},
    Statistic{"median", [](const std::vector<double>& values) { return median(values); }, 1, true,
              true},
    Statistic{"rmse", root_mean_square, 1, true, false},
    Statistic{"p95", p95_of_magnitudes, 1, true, false},
};

/// One number per statistic, in their order.
using Statistics = std::array<double, kStatistics.size()>;

/// The statistics of `values`; NaN for those that require more values.
Statistics statistics_of(const std::vector<double>& values);

/// The names of all statistics, in their order.
std::vector<std::string> statistic_names();

/// The index of the statistic `name`. Throws std::logic_error for an unknown name.
constexpr std::size_t statistic_index(std::string_view name) {
  for (std::size_t k = 0; k < kStatistics.size(); ++k) {
    if (name == kStatistics[k].name) return k;
  }
  throw std::logic_error("unknown statistic");
}

}  // namespace croon::experiments

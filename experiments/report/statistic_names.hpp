#pragma once

#include "experiments/report/summary.hpp"

namespace croon::experiments {

/// One statistic: its name in files and where it is.
struct Statistic {
  const char* name;
  double MeasureStatistics::*value;
};

/// The statistics in the order of the files.
inline constexpr Statistic kStatistics[] = {{"mean", &MeasureStatistics::mean},
                                            {"std", &MeasureStatistics::std},
                                            {"median", &MeasureStatistics::median},
                                            {"rmse", &MeasureStatistics::rmse},
                                            {"p95", &MeasureStatistics::p95}};

}  // namespace croon::experiments

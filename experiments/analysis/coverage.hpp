#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/analysis/summary.hpp"

namespace croon::experiments {

/// The levels of intervals at which coverage is counted, ascending.
inline constexpr std::array kCoverageLevels = {0.05, 0.1,  0.2, 0.3,  0.4, 0.5,  0.6,
                                               0.7,  0.75, 0.8, 0.85, 0.9, 0.95, 0.99};

/// The levels of them that tables for readers show.
inline constexpr std::array kShownCoverageLevels = {0.5, 0.9, 0.95};

/// How often the intervals of one degree of freedom hold the truth, or the ellipsoids of all six.
struct CoverageRow {
  std::string variant;
  std::string sensor;       ///< Empty for all together.
  std::optional<Dof> dof;   ///< std::nullopt for the ellipsoid of all six.
  std::vector<Share> held;  ///< By level: the trials whose interval holds the truth.
};

/// The normalised squared error `e^T C^-1 e` of the trials of one variant and sensor. If errors are
/// normal and covariances right it has the chi-squared distribution of six degrees of freedom:
/// mean 6, median 5.35. Trials in which it is infinite are left out: `trials` counts the others.
struct NormalisedErrors {
  std::string variant;
  std::string sensor;  ///< Empty for all together.
  int trials = 0;
  double mean = 0.0;
  double median = 0.0;
  std::optional<Interval> interval;  ///< 95 % bootstrap interval of the median, over scenes; none
                                     ///< for fewer than `kLeastScenes`.
};

/// Covariances held against the truth, over the trials that the program accepts and that have a
/// covariance and a truth.
struct Coverage {
  std::vector<CoverageRow> rows;         ///< By variant, then sensor, all together last, then Dof.
  std::vector<NormalisedErrors> errors;  ///< Likewise; none without a trial.
};

/// "roll" … "z", or "all" for the ellipsoid of all six.
std::string name_of_dof(const CoverageRow& row);

/// The half width of the interval of a level, in standard deviations.
double half_width_of(double level);

/// `error^T covariance^-1 error`, over the directions in which the covariance is not zero; infinite
/// if the error is not zero in a degree of freedom whose variance is.
double normalised_squared_error(const Vector6d& error, const Matrix6d& covariance);

/// The coverage of the covariances of `records`, whose summary is `summary`.
Coverage coverage_of(const std::vector<TrialRecord>& records, const Summary& summary);

}  // namespace croon::experiments

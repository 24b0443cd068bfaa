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

/// The levels shown in tables for readers.
inline constexpr std::array kShownCoverageLevels = {0.5, 0.9, 0.95};

/// How often the intervals of one degree of freedom, or the ellipsoids of all six, contain ground
/// truth.
struct CoverageRow {
  std::string variant;
  std::string sensor;       ///< Empty for all sensors together.
  std::optional<Dof> dof;   ///< std::nullopt for the ellipsoid of all six.
  std::vector<Share> held;  ///< By level: the trials whose interval contains ground truth.
};

/// The normalised squared error `e^T C^-1 e` of the trials of one variant and sensor. For normal
/// errors and correct covariances it has the chi-squared distribution of six degrees of freedom:
/// mean 6, median 5.35. Trials with an infinite value are left out and not included in `trials`.
struct NormalisedErrors {
  std::string variant;
  std::string sensor;  ///< Empty for all sensors together.
  int trials = 0;
  double mean = 0.0;
  double median = 0.0;
  std::optional<Interval> interval;  ///< 95 % bootstrap interval of the median, over scenes;
                                     ///< requires `kMinScenes`.
};

/// Covariances compared with ground truth, over the accepted trials that have a covariance and
/// ground truth.
struct Coverage {
  std::vector<CoverageRow> rows;  ///< By variant, sensor (all sensors together last) and Dof.
  std::vector<NormalisedErrors> errors;  ///< By variant and sensor; none without trials.
};

/// The name of a row's degree of freedom: "roll" … "z", or "all" for the ellipsoid of all six.
std::string name_of_dof(const CoverageRow& row);

/// The half width of the interval of a level, in standard deviations.
double half_width_of(double level);

/// `error^T covariance^-1 error`, in the directions in which the covariance is not zero; infinite
/// if the error is not zero in a degree of freedom of variance zero.
double normalised_squared_error(const Vector6d& error, const Matrix6d& covariance);

/// The coverage of the covariances of `records`, whose summary is `summary`.
Coverage coverage_of(const std::vector<TrialRecord>& records, const Summary& summary);

}  // namespace croon::experiments

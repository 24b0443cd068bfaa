#pragma once

#include <vector>

namespace croon {

// These functions throw std::logic_error for an empty sample unless their comment says otherwise.
// Sums are compensated (Neumaier 1974), so neither many values nor a large common offset costs
// digits.

/// The sum, compensated (Neumaier 1974); 0 for no values.
double compensated_sum(const std::vector<double>& values);

/// The arithmetic mean.
double mean(const std::vector<double>& values);

/// The sample standard deviation (n - 1), in two passes; NaN for a single value, whose spread is
/// unknown.
double standard_deviation(const std::vector<double>& values);

/// The root of the mean of the squares.
double root_mean_square(const std::vector<double>& values);

/// The value below which a fraction `ratio` in [0, 1] of the sample lies, with linear interpolation
/// between order statistics (Hyndman and Fan 1996, type 7).
double percentile(std::vector<double> values, double ratio);

/// The middle value, or the mean of the middle two.
double median(std::vector<double> values);

/// An interval [low, high].
struct Interval {
  double low;
  double high;
};

/// The 95 % score interval of a proportion of `successes` in `trials` (Wilson 1927); [0, 1] without
/// trials.
Interval wilson_interval(int successes, int trials);

/// The same for a proportion in [0, 1] and an effective number `trials` of independent trials,
/// which must be positive but need not be whole.
Interval wilson_interval(double proportion, double trials);

/// The numbers of a box plot (Tukey 1977).
struct BoxPlot {
  double lower_quartile;
  double median;
  double upper_quartile;
  double lower_whisker;          ///< The minimum value within 1.5 interquartile ranges of the box.
  double upper_whisker;          ///< The maximum value within that range.
  std::vector<double> outliers;  ///< The values beyond the whiskers, ascending.
};

BoxPlot box_plot(std::vector<double> values);

}  // namespace croon

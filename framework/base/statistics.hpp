#pragma once

#include <vector>

namespace croon {

// They throw std::logic_error on an empty sample unless they say what its value is. Sums are
// compensated (Neumaier 1974), so neither the number of values nor one common large offset costs
// digits.

/// The sum, compensated (Neumaier 1974); 0 for no values.
double compensated_sum(const std::vector<double>& values);

/// The arithmetic mean.
double mean(const std::vector<double>& values);

/// The sample standard deviation (n - 1), in two passes; not a number for one value, whose spread
/// is not known.
double standard_deviation(const std::vector<double>& values);

/// The root of the mean of the squares.
double root_mean_square(const std::vector<double>& values);

/// The value below which a share `ratio` in [0, 1] of the sample lies, linear between order
/// statistics (Hyndman and Fan 1996, type 7).
double percentile(std::vector<double> values, double ratio);

/// The middle value, or the mean of the middle two.
double median(std::vector<double> values);

/// From low to high.
struct Interval {
  double low;
  double high;
};

/// The 95 % score interval of a proportion, `successes` of `trials` (Wilson 1927); [0, 1] if
/// there were no trials.
Interval wilson_interval(int successes, int trials);

/// The same of a proportion in [0, 1] that is known as well as one of `trials` independent trials,
/// more than 0 and not always a whole number.
Interval wilson_interval(double proportion, double trials);

/// The numbers of a box plot (Tukey 1977).
struct BoxPlot {
  double lower_quartile;
  double median;
  double upper_quartile;
  double lower_whisker;          ///< The least value within 1.5 interquartile ranges of the box.
  double upper_whisker;          ///< The greatest.
  std::vector<double> outliers;  ///< The values beyond, ascending.
};

BoxPlot box_plot(std::vector<double> values);

}  // namespace croon

#include "framework/base/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

namespace croon {

namespace {

void require_values(const std::vector<double>& values) {
  if (values.empty()) throw std::logic_error("a statistic of no values");
}

/// The zero-based rank of a percentile among `count` values; fractional between two values.
double percentile_rank(std::size_t count, double ratio) {
  return ratio * static_cast<double>(count - 1);
}

/// `percentile` of sorted values. Reads only the two values next to the rank.
double percentile_of_sorted(const std::vector<double>& sorted, double ratio) {
  const double rank = percentile_rank(sorted.size(), ratio);
  const auto below = static_cast<std::size_t>(rank);
  const double low = sorted[below];
  const double high = sorted[std::min(below + 1, sorted.size() - 1)];
  return low + (rank - static_cast<double>(below)) * (high - low);
}

}  // namespace

double compensated_sum(const std::vector<double>& values) {
  double sum = 0.0;
  double lost = 0.0;
  for (const double value : values) {
    const double next = sum + value;
    lost += std::abs(sum) >= std::abs(value) ? (sum - next) + value : (value - next) + sum;
    sum = next;
  }
  return sum + lost;
}

double mean(const std::vector<double>& values) {
  require_values(values);
  return compensated_sum(values) / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  const double centre = mean(values);
  if (values.size() == 1) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> squares;
  squares.reserve(values.size());
  for (const double value : values) squares.push_back((value - centre) * (value - centre));
  return std::sqrt(compensated_sum(squares) / static_cast<double>(values.size() - 1));
}

double root_mean_square(const std::vector<double>& values) {
  std::vector<double> squares;
  squares.reserve(values.size());
  for (const double value : values) squares.push_back(value * value);
  return std::sqrt(mean(squares));
}

double percentile(std::vector<double> values, double ratio) {
  require_values(values);
  if (!(ratio >= 0.0 && ratio <= 1.0)) throw std::logic_error("a percentile's ratio is in [0, 1]");
  // Moves only the two required values to their sorted positions, which takes linear time.
  const auto below =
      values.begin() + static_cast<std::ptrdiff_t>(percentile_rank(values.size(), ratio));
  std::nth_element(values.begin(), below, values.end());
  const auto above = below + 1;
  if (above != values.end()) std::iter_swap(above, std::min_element(above, values.end()));
  return percentile_of_sorted(values, ratio);
}

double median(std::vector<double> values) { return percentile(std::move(values), 0.5); }

Interval wilson_interval(int successes, int trials) {
  if (successes < 0 || successes > trials) throw std::logic_error("more successes than trials");
  if (trials == 0) return {0.0, 1.0};
  return wilson_interval(successes / static_cast<double>(trials), static_cast<double>(trials));
}

Interval wilson_interval(double proportion, double trials) {
  const double z = 1.959963984540054;  // 97.5 % quantile of the normal distribution.
  const double n = trials;
  const double p = proportion;
  const double centre = p + z * z / (2.0 * n);
  const double half_width = z * std::sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n));
  const double scale = 1.0 + z * z / n;
  // At the ends the two terms are equal, and only rounding would move the bounds off 0 and 1.
  return {p == 0.0 ? 0.0 : (centre - half_width) / scale,
          p == 1.0 ? 1.0 : (centre + half_width) / scale};
}

BoxPlot box_plot(std::vector<double> values) {
  require_values(values);
  std::sort(values.begin(), values.end());
  BoxPlot box;
  box.lower_quartile = percentile_of_sorted(values, 0.25);
  box.median = percentile_of_sorted(values, 0.5);
  box.upper_quartile = percentile_of_sorted(values, 0.75);
  const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
  const auto first = std::lower_bound(values.begin(), values.end(), box.lower_quartile - reach);
  const auto last = std::upper_bound(first, values.end(), box.upper_quartile + reach);
  // Interpolated quartiles lie between values, so a whisker could end inside the box.
  box.lower_whisker = std::min(*first, box.lower_quartile);
  box.upper_whisker = std::max(*(last - 1), box.upper_quartile);
  box.outliers.assign(values.begin(), first);
  box.outliers.insert(box.outliers.end(), last, values.end());
  return box;
}

}  // namespace croon

#include "framework/base/statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

std::vector<double> random_values(Rng& rng, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(rng.uniform(-3.0, 5.0));
  return values;
}

TEST(Statistics, KnownValues) {
  const std::vector<double> values = {2, 4, 4, 4, 5, 5, 7, 9};
  EXPECT_DOUBLE_EQ(mean(values), 5.0);
  EXPECT_DOUBLE_EQ(standard_deviation(values), std::sqrt(32.0 / 7.0));
  EXPECT_DOUBLE_EQ(median(values), 4.5);
  EXPECT_DOUBLE_EQ(root_mean_square(values), std::sqrt(29.0));
}

TEST(Statistics, OneValue) {
  EXPECT_EQ(mean({-3.0}), -3.0);
  EXPECT_TRUE(std::isnan(standard_deviation({-3.0})));
  EXPECT_EQ(median({-3.0}), -3.0);
  EXPECT_EQ(root_mean_square({-3.0}), 3.0);
  EXPECT_EQ(percentile({-3.0}, 0.95), -3.0);
}

TEST(Statistics, NoValuesAreAMistakeOfOurs) {
  EXPECT_THROW(mean({}), std::logic_error);
  EXPECT_THROW(standard_deviation({}), std::logic_error);
  EXPECT_THROW(median({}), std::logic_error);
  EXPECT_THROW(root_mean_square({}), std::logic_error);
  EXPECT_THROW(percentile({}, 0.5), std::logic_error);
  EXPECT_THROW(percentile({1.0}, 1.5), std::logic_error);
  EXPECT_THROW(box_plot({}), std::logic_error);
  EXPECT_EQ(compensated_sum({}), 0.0);
}

TEST(Statistics, SumsKeepWhatIsSmallBesideWhatIsLarge) {
  EXPECT_EQ(compensated_sum({1.0, 1e100, 1.0, -1e100}), 2.0);  // Neumaier's own example.
  EXPECT_EQ(mean(std::vector<double>(1000000, 0.1)), 0.1);
}

TEST(Statistics, ALargeOffsetCostsTheSpreadNoDigits) {
  Rng rng = test::test_rng();
  std::vector<double> values;
  for (int i = 0; i < 10000; ++i) values.push_back(static_cast<double>(rng.below(1000)));
  std::vector<double> shifted = values;
  for (double& value : shifted) value += 1e9;
  EXPECT_NEAR(standard_deviation(shifted), standard_deviation(values), 1e-9);
  EXPECT_DOUBLE_EQ(mean(shifted), 1e9 + mean(values));
}

TEST(Statistics, MeanSquareIsSquaredMeanAndVariance) {
  Rng rng = test::test_rng();
  for (int count = 2; count < 200; ++count) {
    const std::vector<double> values = random_values(rng, count);
    const double variance = std::pow(standard_deviation(values), 2) * (count - 1) / count;
    EXPECT_NEAR(std::pow(root_mean_square(values), 2), std::pow(mean(values), 2) + variance, 1e-12);
  }
}

TEST(Statistics, PercentilesAreType7) {
  std::vector<double> values(10);
  std::iota(values.begin(), values.end(), 1.0);
  EXPECT_DOUBLE_EQ(percentile(values, 0.95), 9.55);  // R: quantile(1:10, 0.95)
  EXPECT_DOUBLE_EQ(percentile(values, 0.25), 3.25);
  EXPECT_EQ(percentile(values, 0.0), 1.0);
  EXPECT_EQ(percentile(values, 1.0), 10.0);
}

TEST(Statistics, PercentilesHitTheOrderStatisticsAndGrow) {
  Rng rng = test::test_rng();
  for (int count = 1; count < 60; ++count) {
    const std::vector<double> values = random_values(rng, count);
    std::vector<double> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    double last = sorted.front();
    for (int i = 0; i <= 100; ++i) {
      const double value = percentile(values, i / 100.0);
      EXPECT_GE(value, last - 1e-12);
      last = value;
    }
    for (int i = 0; i < count; ++i) {
      const double ratio = count == 1 ? 0.5 : static_cast<double>(i) / (count - 1);
      EXPECT_NEAR(percentile(values, ratio), sorted[static_cast<std::size_t>(i)], 1e-12);
    }
  }
}

TEST(WilsonInterval, KnownValues) {
  const Interval eight_of_ten = wilson_interval(8, 10);  // R: prop.test(8, 10, correct = FALSE)
  EXPECT_NEAR(eight_of_ten.low, 0.4901625, 1e-7);
  EXPECT_NEAR(eight_of_ten.high, 0.9433178, 1e-7);
  EXPECT_EQ(wilson_interval(0, 0).low, 0.0);
  EXPECT_EQ(wilson_interval(0, 0).high, 1.0);
  EXPECT_EQ(wilson_interval(0, 7).low, 0.0);
  EXPECT_EQ(wilson_interval(7, 7).high, 1.0);
  EXPECT_THROW(wilson_interval(3, 2), std::logic_error);
  EXPECT_THROW(wilson_interval(-1, 2), std::logic_error);
}

TEST(WilsonInterval, EndsAreTheProportionsThatTheScoreTestJustAllows) {
  for (const int trials : {1, 2, 10, 250, 1899}) {
    for (int successes = 0; successes <= trials; successes += std::max(1, trials / 17)) {
      const double seen = static_cast<double>(successes) / trials;
      const Interval interval = wilson_interval(successes, trials);
      EXPECT_LE(interval.low, seen);
      EXPECT_GE(interval.high, seen);
      for (const double p : {interval.low, interval.high}) {
        if (p == 0.0 || p == 1.0) continue;
        EXPECT_NEAR(std::abs(seen - p) / std::sqrt(p * (1.0 - p) / trials), 1.959963984540054,
                    1e-6);
      }
      const Interval mirrored = wilson_interval(trials - successes, trials);
      EXPECT_NEAR(mirrored.low, 1.0 - interval.high, 1e-12);
    }
  }
}

TEST(BoxPlot, KnownValues) {
  const BoxPlot box = box_plot({100, 1, 2, 3, 4, 5, 6, 7, 8, 9, -50});
  EXPECT_DOUBLE_EQ(box.lower_quartile, 2.5);
  EXPECT_DOUBLE_EQ(box.median, 5.0);
  EXPECT_DOUBLE_EQ(box.upper_quartile, 7.5);
  EXPECT_EQ(box.lower_whisker, 1.0);
  EXPECT_EQ(box.upper_whisker, 9.0);
  EXPECT_EQ(box.outliers, (std::vector<double>{-50, 100}));
}

TEST(BoxPlot, PartsStandInOrderAndLoseNoValue) {
  Rng rng = test::test_rng();
  for (int count = 1; count < 100; ++count) {
    std::vector<double> values;
    for (int i = 0; i < count; ++i) values.push_back(std::pow(rng.normal(), 3));
    const BoxPlot box = box_plot(values);
    EXPECT_LE(box.lower_whisker, box.lower_quartile);
    EXPECT_LE(box.lower_quartile, box.median);
    EXPECT_LE(box.median, box.upper_quartile);
    EXPECT_LE(box.upper_quartile, box.upper_whisker);
    const double reach = 1.5 * (box.upper_quartile - box.lower_quartile);
    const auto beyond = std::count_if(values.begin(), values.end(), [&](double value) {
      return value < box.lower_quartile - reach || value > box.upper_quartile + reach;
    });
    EXPECT_EQ(static_cast<long>(box.outliers.size()), beyond);
  }
}

}  // namespace
}  // namespace croon

#include "experiments/statistics/bootstrap.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "test/experiments/statistics/simulated_experiments.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(Pairs, InfiniteDifferences) {
  EXPECT_EQ(differences({{1.0, kInf, 2.0, kInf}, {3.0, 1.0, kInf, kInf}}),
            (std::vector<double>{2.0, -kInf, kInf, 0.0}));
}

TEST(Pairs, MedianWithFailures) {
  EXPECT_EQ(median_with_failures({3.0, 1.0, kInf}), 3.0);
  EXPECT_EQ(median_with_failures({4.0, 1.0, 2.0, kInf}), 3.0);
  EXPECT_EQ(median_with_failures({1.0, kInf}), kInf);
  EXPECT_EQ(median_with_failures({kInf, kInf}), kInf);
  EXPECT_THROW(median_with_failures({}), std::logic_error);
}

TEST(Bootstrap, CoversTheTrueDifference) {
  Rng rng = croon::test::test_rng();
  constexpr int kExperiments = 300;
  for (const double failure_ratio : {0.0, 0.2}) {
    int covered = 0;
    for (int i = 0; i < kExperiments; ++i) {
      test::MadeUp like;
      like.scenes = 60;
      like.effect = 0.5;
      like.failure_ratio = failure_ratio;
      const Interval interval = median_difference_interval(draw_experiment(rng, like).pairs);
      // Both sides fail as often: their medians are shifted alike.
      covered += interval.low <= 0.5 && 0.5 <= interval.high;
    }
    // 95 %, less three standard deviations (1.26 %) and the two that the method may lack.
    EXPECT_GE(covered, kExperiments * 0.89);
    EXPECT_LT(covered, kExperiments);
  }
}

TEST(Bootstrap, IsTheSameBitsAgain) {
  Rng rng = croon::test::test_rng();
  const Pairs pairs = test::draw_experiment(rng, {40, 3, 0.2, 0.5, 0.1, 0.1, 0.0}).pairs;
  const Interval once = median_difference_interval(pairs);
  const Interval again = median_difference_interval(pairs);
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
}

TEST(Bootstrap, SwappedSidesFlipTheInterval) {
  Rng rng = croon::test::test_rng();
  for (const std::size_t scenes : {7U, 50U}) {
    const Pairs pairs = test::draw_experiment(rng, {scenes, 1, 0.2, 0.5, 0.3, 0.1, 0.25}).pairs;
    const Interval interval = median_difference_interval(pairs);
    const Interval swapped = median_difference_interval({pairs.variant, pairs.base});
    EXPECT_EQ(swapped.low, -interval.high);
    EXPECT_EQ(swapped.high, -interval.low);
  }
}

TEST(Bootstrap, EndsMayBeInfinite) {
  // The variant fails in every second trial.
  Pairs pairs;
  for (int i = 0; i < 41; ++i) {
    pairs.base.push_back(1.0 + 0.01 * i);
    pairs.variant.push_back(i % 2 == 0 ? kInf : 1.0);
  }
  const Interval interval = median_difference_interval(pairs);
  EXPECT_LT(interval.low, 0.0);
  EXPECT_EQ(interval.high, kInf);
  const Interval none = median_difference_interval({{kInf, kInf}, {kInf, kInf}});
  EXPECT_EQ(none.low, 0.0);
  EXPECT_EQ(none.high, 0.0);
}

TEST(Bootstrap, OfOnePairIsItsDifference) {
  const Interval interval = median_difference_interval({{1.0}, {3.5}});
  EXPECT_EQ(interval.low, 2.5);
  EXPECT_EQ(interval.high, 2.5);
  EXPECT_THROW(median_difference_interval({}), std::logic_error);
}

}  // namespace
}  // namespace croon::experiments

#include "experiments/analysis/paired_tests.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "test/experiments/analysis/simulated_experiments.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

constexpr double kBootstrapInf = std::numeric_limits<double>::infinity();

TEST(Pairs, InfiniteDifferences) {
  EXPECT_EQ(differences({{1.0, kBootstrapInf, 2.0, kBootstrapInf},
                         {3.0, 1.0, kBootstrapInf, kBootstrapInf}}),
            (std::vector<double>{2.0, -kBootstrapInf, kBootstrapInf, 0.0}));
}

TEST(Pairs, MedianWithFailures) {
  EXPECT_EQ(median_with_failures({3.0, 1.0, kBootstrapInf}), 3.0);
  EXPECT_EQ(median_with_failures({4.0, 1.0, 2.0, kBootstrapInf}), 3.0);
  EXPECT_EQ(median_with_failures({1.0, kBootstrapInf}), kBootstrapInf);
  EXPECT_EQ(median_with_failures({kBootstrapInf, kBootstrapInf}), kBootstrapInf);
  EXPECT_EQ(median_with_failures({-kBootstrapInf, -kBootstrapInf}), -kBootstrapInf);
  EXPECT_EQ(median_with_failures({kBootstrapInf, -kBootstrapInf}), 0.0);
  EXPECT_THROW(median_with_failures({}), std::logic_error);
}

constexpr int kExperiments = 300;

/// In how many of kExperiments the interval holds the difference that was put in.
int count_covered(const test::MadeUp& like) {
  Rng rng = croon::test::test_rng();
  int covered = 0;
  for (int i = 0; i < kExperiments; ++i) {
    const test::DrawnExperiment drawn = draw_experiment(rng, like);
    const Interval interval = median_difference_interval(drawn.pairs, drawn.scenes);
    covered += interval.low <= like.effect && like.effect <= interval.high;
  }
  return covered;
}

TEST(Bootstrap, CoversTheTrueDifference) {
  for (const double failure_ratio : {0.0, 0.2}) {
    test::MadeUp like;
    like.scenes = 60;
    like.effect = 0.5;
    like.failure_ratio = failure_ratio;  // Of both sides: their medians are shifted alike.
    const int covered = count_covered(like);
    // 95 %, less three standard deviations (1.26 %) and the two that the method may lack.
    EXPECT_GE(covered, kExperiments * 0.89);
    EXPECT_LT(covered, kExperiments);
  }
}

TEST(Bootstrap, CoversItWhereTrialsOfASceneAreAlike) {
  test::MadeUp like;
  like.scenes = 12;
  like.trials = 20;
  like.effect = 0.5;
  like.scene_effect = 2.0;
  const int covered = count_covered(like);
  // With few scenes, an interval of percentiles is somewhat short. Over trials alone it would cover
  // 60 % and less.
  EXPECT_GE(covered, kExperiments * 0.88);
  EXPECT_LT(covered, kExperiments);
}

TEST(Bootstrap, IsTheSameBitsAgain) {
  Rng rng = croon::test::test_rng();
  const test::DrawnExperiment drawn = test::draw_experiment(rng, {40, 3, 0.2, 0.5, 0.1, 0.1, 0.0});
  const Interval once = median_difference_interval(drawn.pairs, drawn.scenes);
  const Interval again = median_difference_interval(drawn.pairs, drawn.scenes);
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
}

TEST(Bootstrap, NumbersOfClustersAreNames) {
  Rng rng = croon::test::test_rng();
  test::DrawnExperiment drawn = test::draw_experiment(rng, {10, 3, 0.2, 0.5, 0.1, 0.1, 0.0});
  const Interval once = median_difference_interval(drawn.pairs, drawn.scenes);
  for (std::size_t& scene : drawn.scenes) scene = 3 * scene + 2;
  const Interval again = median_difference_interval(drawn.pairs, drawn.scenes);
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
}

TEST(Bootstrap, SwappedSidesFlipTheInterval) {
  Rng rng = croon::test::test_rng();
  for (const std::size_t scenes : {7U, 50U}) {
    const test::DrawnExperiment drawn =
        test::draw_experiment(rng, {scenes, 1, 0.2, 0.5, 0.3, 0.1, 0.25});
    const Pairs& pairs = drawn.pairs;
    const Interval interval = median_difference_interval(pairs, drawn.scenes);
    const Interval swapped = median_difference_interval({pairs.variant, pairs.base}, drawn.scenes);
    EXPECT_EQ(swapped.low, -interval.high);
    EXPECT_EQ(swapped.high, -interval.low);
  }
}

TEST(Bootstrap, EndsMayBeInfinite) {
  // The variant fails in every second trial.
  Pairs pairs;
  for (int i = 0; i < 41; ++i) {
    pairs.base.push_back(1.0 + 0.01 * i);
    pairs.variant.push_back(i % 2 == 0 ? kBootstrapInf : 1.0);
  }
  const Interval interval = median_difference_interval(pairs, std::vector<std::size_t>(41, 0));
  EXPECT_LT(interval.low, 0.0);
  EXPECT_EQ(interval.high, kBootstrapInf);
  const Interval none = median_difference_interval(
      {{kBootstrapInf, kBootstrapInf}, {kBootstrapInf, kBootstrapInf}}, {0, 1});
  EXPECT_EQ(none.low, 0.0);
  EXPECT_EQ(none.high, 0.0);
}

TEST(Bootstrap, FailuresOfEitherSideInHalfOfThePairsAreNoDifference) {
  // Only the base failed in the even pairs, only the variant in the odd ones.
  constexpr std::size_t kCount = 40;
  Pairs pairs;
  Clusters scenes;
  for (std::size_t i = 0; i < kCount; ++i) {
    pairs.base.push_back(i % 2 == 0 ? kBootstrapInf : 1.0);
    pairs.variant.push_back(i % 2 == 0 ? 1.0 : kBootstrapInf);
    scenes.push_back(i);
  }
  const std::vector<double> paired = differences(pairs);
  EXPECT_EQ(median_with_failures(paired), 0.0);
  const Pairs against_zero = {std::vector<double>(kCount, 0.0), paired};
  for (const Clusters& clusters : {scenes, Clusters(kCount, 0)}) {
    for (const Pairs& drawn : {pairs, against_zero}) {
      const Interval interval = median_difference_interval(drawn, clusters);
      EXPECT_EQ(interval.low, -kBootstrapInf);
      EXPECT_EQ(interval.high, kBootstrapInf);
    }
  }
  const std::vector<double> ranks = signed_ranks(paired);
  EXPECT_EQ(wilcoxon_p(ranks), 1.0);
  EXPECT_EQ(sign_flip_p(cluster_sums(ranks, scenes)), 1.0);
}

TEST(Bootstrap, OfOnePairIsItsDifference) {
  const Interval interval = median_difference_interval({{1.0}, {3.5}}, {0});
  EXPECT_EQ(interval.low, 2.5);
  EXPECT_EQ(interval.high, 2.5);
  EXPECT_THROW(median_difference_interval({}, {}), std::logic_error);
}

}  // namespace
}  // namespace croon::experiments

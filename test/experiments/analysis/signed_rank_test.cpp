#include "experiments/analysis/paired_tests.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "test/experiments/analysis/simulated_experiments.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

using test::DrawnExperiment;
using test::MadeUp;
using test::share_significant;

constexpr double kSignedRankInf = std::numeric_limits<double>::infinity();

double p_of(const std::vector<double>& differences) {
  return wilcoxon_p(signed_ranks(differences));
}

double p_of_experiment(const DrawnExperiment& experiment) {
  return p_of(differences(experiment.pairs));
}

TEST(SignedRanks, ZerosTakeTheLowestRanksAndTiesTheirMean) {
  EXPECT_EQ(signed_ranks({0.0, -2.0, 2.0, 0.0, 5.0, -kSignedRankInf, kSignedRankInf}),
            (std::vector<double>{0.0, -3.5, 3.5, 0.0, 5.0, -6.5, 6.5}));
}

TEST(Wilcoxon, HollanderAndWolfesDepressionScores) {
  // Hollander and Wolfe (1973), page 29; the example of R's wilcox.test, whose one-sided p is
  // 0.01953125 (V = 40).
  const Pairs pairs = {{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30},
                       {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29}};
  EXPECT_DOUBLE_EQ(p_of(differences(pairs)), 2.0 * 0.01953125);
}

TEST(Wilcoxon, ByHand) {
  EXPECT_EQ(p_of({}), 1.0);
  EXPECT_EQ(p_of({0.0, 0.0}), 1.0);
  EXPECT_EQ(p_of({0.0, 1.0, 2.0, 3.0}), 2.0 / 8.0);
  // Equal ranks: the sum is at least that far from 0 unless two are positive and two negative.
  EXPECT_EQ(p_of({1.0, 1.0, 1.0, -1.0}), 10.0 / 16.0);
  EXPECT_EQ(p_of({kSignedRankInf, kSignedRankInf, kSignedRankInf, kSignedRankInf, kSignedRankInf,
                  kSignedRankInf}),
            2.0 / 64.0);
}

TEST(Wilcoxon, ExactIsTheShareOfAllSigns) {
  Rng rng = croon::test::test_rng();
  for (int i = 0; i < 100; ++i) {
    std::vector<double> differences;
    for (int k = 0; k < 11; ++k) differences.push_back(static_cast<double>(rng.below(9)) - 4.0);
    const std::vector<double> ranks = signed_ranks(differences);
    EXPECT_DOUBLE_EQ(wilcoxon_p(ranks), sign_flip_p(ranks));
  }
}

TEST(Wilcoxon, NormalIsNearTheExact) {
  Rng rng = croon::test::test_rng();
  for (int i = 0; i < 200; ++i) {
    std::vector<double> differences;
    for (int k = 0; k < 25; ++k) differences.push_back(rng.normal() + 0.3);
    const std::vector<double> ranks = signed_ranks(differences);
    EXPECT_NEAR(wilcoxon_p(ranks), normal_sign_p(ranks), 0.01);
  }
}

TEST(Wilcoxon, SwappedSidesHaveTheSameP) {
  Rng rng = croon::test::test_rng();
  for (const std::size_t scenes : {8U, 60U}) {
    const DrawnExperiment drawn = test::draw_experiment(rng, {scenes, 2, 0.3, 0.0, 0.2, 0.1, 0.25});
    EXPECT_EQ(p_of(differences(drawn.pairs)),
              p_of(differences({drawn.pairs.variant, drawn.pairs.base})));
  }
}

TEST(Wilcoxon, AFailureCountsForMoreThanAnyNumber) {
  const std::vector<double> large = {1.0, -2.0, 3.0, 4.0, -5.0, 6.0, 1e9};
  std::vector<double> failed = large;
  failed.back() = kSignedRankInf;
  EXPECT_EQ(p_of(large), p_of(failed));
}

TEST(Wilcoxon, KeepsItsLevel) {
  MadeUp few, many, failing, tied, rare;
  few.scenes = 12;
  many.scenes = 80;
  failing.failure_ratio = 0.3;
  tied.grain = 1.0;
  rare.scenes = 60;
  rare.grain = 4.0;
  for (const MadeUp& null : {few, many, failing, tied, rare}) {
    EXPECT_LE(share_significant(null, p_of_experiment), test::kMaxFalsePositives);
  }
  // Not by never finding anything.
  EXPECT_GE(share_significant(many, p_of_experiment), 0.03);
}

TEST(Wilcoxon, FindsAnEffect) {
  MadeUp worse, failing;
  worse.effect = 1.0;
  failing.scenes = 60;
  failing.variant_failures = 0.3;
  EXPECT_GE(share_significant(worse, p_of_experiment), 0.9);
  EXPECT_GE(share_significant(failing, p_of_experiment), 0.6);
}

}  // namespace
}  // namespace croon::experiments

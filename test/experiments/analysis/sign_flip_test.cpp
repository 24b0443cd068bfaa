#include "experiments/analysis/paired_tests.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/experiments/analysis/simulated_experiments.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

using test::DrawnExperiment;
using test::MadeUp;
using test::share_significant;

double rank_p(const DrawnExperiment& experiment) {
  return sign_flip_p(cluster_sums(signed_ranks(differences(experiment.pairs)), experiment.scenes));
}

double success_p(const DrawnExperiment& experiment) {
  return sign_flip_p(cluster_sums(experiment.success, experiment.scenes));
}

/// Trials of a scene are alike: a scene is better or worse as a whole.
MadeUp clustered(std::size_t scenes) {
  MadeUp like;
  like.scenes = scenes;
  like.trials = 20;
  like.scene_effect = 2.0;
  return like;
}

TEST(SignFlip, ByHand) {
  EXPECT_EQ(cluster_sums({1.0, 2.0, -4.0, 8.0}, {1, 0, 1, 3}),
            (std::vector<double>{2.0, -3.0, 0.0, 8.0}));
  EXPECT_EQ(sign_flip_p({}), 1.0);
  EXPECT_EQ(sign_flip_p({0.0, 0.0}), 1.0);
  EXPECT_EQ(sign_flip_p({5.0}), 1.0);
  EXPECT_EQ(sign_flip_p({1.0, 2.0, 3.0}), 2.0 / 8.0);
  EXPECT_EQ(sign_flip_p({1.0, 2.0, -4.0, 0.0}), 1.0);
  // z = (36 - 1) / 6.
  EXPECT_DOUBLE_EQ(sign_flip_p(std::vector<double>(36, 1.0)),
                   std::erfc(35.0 / 6.0 / std::sqrt(2.0)));
}

TEST(SignFlip, OfOneTrialPerSceneIsMcNemars) {
  for (int wins = 0; wins <= 12; ++wins) {
    std::vector<double> scores(12, -1.0);
    for (int i = 0; i < wins; ++i) scores[static_cast<std::size_t>(i)] = 1.0;
    EXPECT_NEAR(sign_flip_p(scores), mcnemar_p(12 - wins, wins), 1e-12);
  }
}

TEST(SignFlip, NormalIsNearTheExact) {
  Rng rng = croon::test::test_rng();
  for (int i = 0; i < 50; ++i) {
    std::vector<double> sums;
    for (int k = 0; k < 16; ++k) sums.push_back(std::round(100.0 * rng.normal()) + 20.0);
    EXPECT_NEAR(sign_flip_p(sums), normal_sign_p(sums), 0.05);
  }
}

TEST(SignFlip, KeepsItsLevelWhereTrialsOfASceneAreAlike) {
  for (const std::size_t scenes : {8U, 17U, 40U}) {
    MadeUp plain = clustered(scenes), failing = plain, tied = plain;
    failing.failure_ratio = 0.3;
    tied.grain = 1.0;
    for (const MadeUp& null : {plain, failing, tied}) {
      EXPECT_LE(share_significant(null, rank_p), test::kMaxFalsePositives) << scenes;
      EXPECT_LE(share_significant(null, success_p), test::kMaxFalsePositives) << scenes;
    }
  }
}

TEST(SignFlip, TheTestsOverTrialsWouldNotKeepIt) {
  const auto over_trials = [](const DrawnExperiment& experiment) {
    return wilcoxon_p(signed_ranks(differences(experiment.pairs)));
  };
  EXPECT_GE(share_significant(clustered(10), over_trials), 0.3);
}

TEST(SignFlip, KeepsItsLevelWithOneTrialPerScene) {
  for (const std::size_t scenes : {10U, 20U, 60U}) {
    MadeUp like;
    like.scenes = scenes;
    EXPECT_LE(share_significant(like, rank_p), test::kMaxFalsePositives);
    EXPECT_LE(share_significant(like, success_p), test::kMaxFalsePositives);
  }
}

TEST(SignFlip, FindsAnEffect) {
  MadeUp like = clustered(30);
  like.effect = 2.0;
  EXPECT_GE(share_significant(like, rank_p), 0.9);
  EXPECT_GE(share_significant(like, success_p), 0.9);
}

}  // namespace
}  // namespace croon::experiments

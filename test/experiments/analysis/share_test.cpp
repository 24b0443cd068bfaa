#include <gtest/gtest.h>

#include "experiments/analysis/trial_summary.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

/// A world of scenes: a share `hopeless` fails from every start, and in each other scene success
/// has a chance of its own, `chance` +- `scatter`.
struct ClusteredTrials {
  double hopeless = 0.0;
  double chance = 0.9;
  double scatter = 0.0;

  double success() const { return (1.0 - hopeless) * chance; }
};

Share draw(Rng& rng, const ClusteredTrials& world, int scenes, int trials) {
  SceneCounts counts;
  for (int scene = 0; scene < scenes; ++scene) {
    const bool is_hopeless = rng.uniform() < world.hopeless;
    const double sign = rng.uniform() < 0.5 ? -1.0 : 1.0;
    const double chance = is_hopeless ? 0.0 : world.chance + sign * world.scatter;
    int successes = 0;
    for (int trial = 0; trial < trials; ++trial) successes += rng.uniform() < chance;
    counts.add(std::to_string(scene), successes, trials);
  }
  return counts.share();
}

constexpr int kDraws = 2000;

double coverage(const ClusteredTrials& world, int scenes, int trials) {
  Rng rng = croon::test::test_rng();
  int covered = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Share share = draw(rng, world, scenes, trials);
    covered += share.interval && share.interval->low <= world.success() &&
               world.success() <= share.interval->high;
  }
  return static_cast<double>(covered) / kDraws;
}

TEST(ShareInterval, CoversTheTruthThoughTrialsOfASceneAreAlike) {
  for (const ClusteredTrials& world :
       {ClusteredTrials{0.0, 0.9, 0.0}, ClusteredTrials{0.0, 0.5, 0.45},
        ClusteredTrials{0.1, 0.97, 0.02}, ClusteredTrials{0.4, 0.95, 0.05},
        ClusteredTrials{0.5, 1.0, 0.0}}) {
    for (const int scenes : {kMinScenes, 10, 20, 50}) {
      for (const int trials : {1, 10, 50}) {
        const double covered = coverage(world, scenes, trials);
        // Wilson's own coverage of six trials is 89 % for some shares, 96 % on average.
        EXPECT_GE(covered, 0.91) << world.hopeless << " " << world.chance << ": " << scenes
                                 << " scenes of " << trials;
        RecordProperty("coverage_" + std::to_string(world.hopeless) + "_" +
                           std::to_string(world.chance) + "_" + std::to_string(scenes) + "_" +
                           std::to_string(trials),
                       std::to_string(covered));
      }
    }
  }
}

TEST(ShareInterval, OverTrialsWouldNot) {
  // What this replaces: Wilson's interval for the number of trials.
  const ClusteredTrials world{0.4, 0.95, 0.05};
  Rng rng = croon::test::test_rng();
  int covered = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Share share = draw(rng, world, 10, 50);
    const Interval interval = wilson_interval(share.count, share.trials);
    covered += interval.low <= world.success() && world.success() <= interval.high;
  }
  EXPECT_LT(covered, 0.4 * kDraws);
}

TEST(ShareInterval, OfOneTrialPerSceneIsWilsons) {
  SceneCounts counts;
  for (int scene = 0; scene < 10; ++scene) counts.add(std::to_string(scene), scene < 8, 1);
  const Share share = counts.share();
  const Interval wilson = wilson_interval(8, 10);
  ASSERT_TRUE(share.interval);
  EXPECT_EQ(share.ratio, 0.8);
  EXPECT_NEAR(share.interval->low, wilson.low, 1e-12);
  EXPECT_NEAR(share.interval->high, wilson.high, 1e-12);
}

TEST(ShareInterval, MoreTrialsOfTheSameScenesMakeItNoShorter) {
  SceneCounts few, many;
  for (int scene = 0; scene < 8; ++scene) {
    few.add(std::to_string(scene), scene < 6, 1);
    for (int sensor = 0; sensor < 4; ++sensor) {
      many.add(std::to_string(scene), scene < 6 ? 50 : 0, 50);
    }
  }
  EXPECT_EQ(many.share().trials, 1600);
  EXPECT_NEAR(few.share().interval->low, many.share().interval->low, 1e-12);
  EXPECT_NEAR(few.share().interval->high, many.share().interval->high, 1e-12);
}

TEST(ShareInterval, IsAbsentForTooFewScenes) {
  SceneCounts counts;
  EXPECT_FALSE(counts.share().interval);
  for (int scene = 0; scene < kMinScenes; ++scene) {
    EXPECT_FALSE(counts.share().interval) << scene;
    counts.add(std::to_string(scene), 50, 50);
  }
  counts.add("without trials", 0, 0);
  ASSERT_TRUE(counts.share().interval);
  EXPECT_EQ(counts.share().interval->high, 1.0);
  EXPECT_LT(counts.share().interval->low, 0.7);
}

}  // namespace
}  // namespace croon::experiments

// Over how many trials and scenes a claim is.
#include <gtest/gtest.h>

#include "experiments/analysis/claims.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::test_rng;
using test::kBounds;

TEST(Claims, OneTrialOfASceneHasNoSpread) {
  Rng rng = test_rng();
  std::vector<TrialRecord> records;
  for (int scene = 0; scene < 40; ++scene) {
    for (int trial = 0; trial < (scene == 0 ? 2 : 1); ++trial) {
      records.push_back(test::finished({"base", std::to_string(scene), "front", trial},
                                       Status::success, {}, test::random_offset(rng, 0.1, 0.02)));
    }
  }
  Claim one;
  one.variant = "base";
  one.statistic = "within_scene_std";
  one.measure = "x";
  one.band = {0.0, 0.09};
  const ClaimResult result = check_claims({one}, summarise(records, kBounds, {})).front();
  EXPECT_EQ(result.trials, 2);
  EXPECT_EQ(result.scenes, 1);
  EXPECT_EQ(result.outcome, ClaimOutcome::not_enough);
}

}  // namespace
}  // namespace croon::experiments

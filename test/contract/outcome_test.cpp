// A kind of stage that no test knows is run by the steps that hold its stages.
#include "test/contract/outcome.hpp"

#include <gtest/gtest.h>

#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

CloudPair equal_streets() {
  Rng rng = test_rng(11);
  const Points cloud = random_street(rng, 4, 2000, 0.01);
  return cloud_pair(cloud, cloud);
}

TEST(OutcomeOfAnUnknownKind, IsThatOfTheStepsThatHoldIt) {
  const CloudPair clouds = equal_streets();
  const Outcome lenient =
      outcome_of("verifier", R"({"type": "tilt", "max_tilt_deg": 180})", clouds);
  const Outcome strict = outcome_of("verifier", R"({"type": "tilt", "max_tilt_deg": 0})", clouds);
  EXPECT_EQ(lenient.stage_error, "");
  EXPECT_FALSE(lenient.numbers.empty());
  EXPECT_NE(lenient.bits(), strict.bits());
}

TEST(OutcomeOfAnUnknownKind, NeedsAStepThatHoldsIt) {
  try {
    outcome_of("judge", R"({"type": "strict"})", equal_streets());
    FAIL() << "ran a stage that no step holds";
  } catch (const std::logic_error& error) {
    EXPECT_STREQ(error.what(),
                 "no test runs stages of the kind \"judge\": no step has a slot of it");
  }
}

}  // namespace
}  // namespace croon::test

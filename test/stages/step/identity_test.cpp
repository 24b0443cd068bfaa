#include <gtest/gtest.h>

#include "framework/geometry/dof.hpp"
#include "framework/stage/step.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

TEST(Identity, ReturnsThePoseItWasGiven) {
  Rng rng = test::test_rng();
  const params::Slot<Step> identity = test::stage<Step>(R"({"step": "identity"})");
  Estimate estimate;
  estimate.T_target_source = test::random_pose(rng, 5.0);
  const Estimate after = identity->advance(estimate, rng);
  EXPECT_EQ(after.T_target_source.rotation, estimate.T_target_source.rotation);
  EXPECT_EQ(after.T_target_source.translation, estimate.T_target_source.translation);
}

}  // namespace
}  // namespace croon

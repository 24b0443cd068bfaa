#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

TEST(Registration, RegistersAndReports) {
  Rng rng = test::test_rng();
  test::StreetEstimate street = test::street_estimate(5);
  street.estimate.T_target_source = test::pose_near(rng, street.truth, 2.0, 0.2);
  const auto step = test::stage<Step>(R"({"step": "registration"})");
  const Estimate after = step->advance(street.estimate, rng);
  const PoseError error = pose_error(after.T_target_source, street.truth);
  EXPECT_LT(deg_from_rad(error.rotation_rad), 0.1);
  EXPECT_LT(error.translation_m, 0.02);
  ASSERT_TRUE(after.information);
  EXPECT_FALSE(after.rejection);
  EXPECT_GT(test::diagnostic(after, "inlier_ratio"), 0.5);
  EXPECT_EQ(test::diagnostic(after, "converged"), 1.0);
}

TEST(Registration, RejectsWhatItShouldNotTrust) {
  Rng rng = test::test_rng();
  test::StreetEstimate street = test::street_estimate(5);
  const auto step = test::stage<Step>(R"({"step": "registration", "min_inlier_ratio": 1.0})");
  const Estimate after = step->advance(street.estimate, rng);
  ASSERT_TRUE(after.rejection);
  EXPECT_NE(after.rejection->find("inlier ratio"), std::string::npos);
}

}  // namespace
}  // namespace croon

// The example of docs/extending.md.
#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

TEST(OverlapAlignment, MovesBackOverTheGroundAndNowhereElse) {
  const auto step = test::stage<Step>(R"({"step": "overlap_alignment", "range_m": 3})");
  Rng rng = test::test_rng();
  for (int trial = 0; trial < 5; ++trial) {
    test::StreetEstimate street = test::street_estimate(4);
    RigidTransform& T = street.estimate.T_target_source;
    T.translation += Eigen::Vector3d{rng.uniform(-2.5, 2.5), rng.uniform(-2.5, 2.5), 0.05};
    const Estimate after = step->advance(street.estimate, rng);
    const Vector6d error = pose_error(after.T_target_source, street.truth).dof;
    // A cell is 0.2 m.
    EXPECT_LT(error.segment<2>(3).cwiseAbs().maxCoeff(), 0.21);
    EXPECT_NEAR(error(5), 0.05, 1e-12);
    EXPECT_LT(error.head<3>().norm(), 1e-7);
    ASSERT_EQ(after.diagnostics[0].first, "overlap_ratio");
    EXPECT_GT(after.diagnostics[0].second, 0.5);
    EXPECT_LE(after.diagnostics[0].second, 1.0);
  }
}

TEST(OverlapAlignment, TellsTheCheckHowFarTheCloudsOverlap) {
  Rng rng = test::test_rng();
  const Estimate after = test::stage<Step>(R"({"step": "overlap_alignment"})")
                             ->advance(test::street_estimate(4).estimate, rng);
  const double overlap_ratio = after.diagnostics[0].second;
  for (const double min_ratio : {0.5 * overlap_ratio, 0.5 + 0.5 * overlap_ratio}) {
    const auto check = test::stage<Step>(R"({"step": "overlap_check", "min_overlap_ratio": )" +
                                         std::to_string(min_ratio) + "}");
    EXPECT_EQ(check->advance(after, rng).rejection.has_value(), min_ratio > overlap_ratio);
  }
  EXPECT_THROW(test::stage<Step>(R"({"step": "overlap_check"})")
                   ->advance(test::street_estimate(4).estimate, rng),
               StageError);
}

TEST(OverlapAlignment, StaysIfNoShiftIsBetter) {
  const auto step = test::stage<Step>(R"({"step": "overlap_alignment", "points": "all"})");
  Rng rng = test::test_rng();
  test::StreetEstimate street = test::street_estimate(4);
  street.estimate.source = street.estimate.target;
  street.estimate.T_target_source = {};
  const Estimate after = step->advance(street.estimate, rng);
  EXPECT_EQ(after.T_target_source.translation, Eigen::Vector3d::Zero());
  EXPECT_EQ(after.diagnostics[0].second, 1.0);
}

TEST(OverlapAlignment, RefusesCloudsThatShareNoCell) {
  const auto step = test::stage<Step>(R"({"step": "overlap_alignment"})");
  Rng rng = test::test_rng();
  test::StreetEstimate street = test::street_estimate(4);
  street.estimate.T_target_source.translation.x() += 1000.0;
  try {
    step->advance(street.estimate, rng);
    FAIL() << "aligned clouds that are a kilometre apart";
  } catch (const StageError& error) {
    EXPECT_STREQ(error.what(), "the two clouds share no cell at any shift within range_m");
  }
}

}  // namespace
}  // namespace croon

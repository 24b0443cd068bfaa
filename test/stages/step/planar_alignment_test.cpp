#include <gtest/gtest.h>

#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

TEST(PlanarAlignment, MovesBackOverTheGroundAndNowhereElse) {
  const auto step = test::stage<Step>(R"({"step": "planar_alignment"})");
  Rng rng = test::test_rng();
  for (int trial = 0; trial < 5; ++trial) {
    test::StreetEstimate street = test::street_estimate(4);
    RigidTransform& T = street.estimate.T_target_source;
    T.translation += Eigen::Vector3d{rng.uniform(-0.4, 0.4), rng.uniform(-0.4, 0.4), 0.05};
    const Estimate after = step->advance(street.estimate, rng);
    const Vector6d error = pose_error(after.T_target_source, street.truth).dof;
    // Its step is 0.1 m.
    EXPECT_LT(error.segment<2>(3).cwiseAbs().maxCoeff(), 0.11);
    EXPECT_NEAR(error(5), 0.05, 1e-12);
    EXPECT_LT(error.head<3>().norm(), 1e-7);
  }
}

}  // namespace
}  // namespace croon

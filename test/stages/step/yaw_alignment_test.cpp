#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

TEST(YawAlignment, TurnsBackFromAnyYawWithinItsRange) {
  for (const char* search : {"binary", "exhaustive", "golden_section"}) {
    const auto step = test::stage<Step>(
        std::string(R"({"step": "yaw_alignment", "search": {"type": ")") + search + "\"}}");
    Rng rng = test::test_rng();
    for (const double yaw_deg : {-80.0, -33.3, 0.0, 12.34, 71.0}) {
      test::StreetEstimate street = test::street_estimate(3);
      const Eigen::Vector3d omega(0.0, 0.0, rad_from_deg(yaw_deg));
      street.estimate.T_target_source.rotation =
          rotation_exp(omega) * street.estimate.T_target_source.rotation;
      const Estimate after = step->advance(street.estimate, rng);
      const PoseError error = pose_error(after.T_target_source, street.truth);
      EXPECT_LT(deg_from_rad(error.rotation_rad), 1.0) << search << " from " << yaw_deg;
      EXPECT_EQ(error.translation_m, 0.0);
    }
  }
}

TEST(YawAlignment, TurnsAboutTheGroundsNormal) {
  Rng rng = test::test_rng();
  test::StreetEstimate street = test::street_estimate(3);
  const Eigen::Vector3d up = Eigen::Vector3d(0.1, -0.2, 1.0).normalized();
  street.estimate.target_ground =
      std::make_shared<const GroundSplit>(GroundSplit{{up, 2.0}, street.estimate.target});
  street.estimate.source_ground =
      std::make_shared<const GroundSplit>(GroundSplit{{up, 2.0}, street.estimate.source});
  street.estimate.T_target_source.rotation =
      rotation_exp(0.3 * up) * street.estimate.T_target_source.rotation;
  const auto step = test::stage<Step>(R"({"step": "yaw_alignment"})");
  const Estimate after = step->advance(street.estimate, rng);
  const Eigen::Matrix3d turn =
      after.T_target_source.rotation * street.estimate.T_target_source.rotation.transpose();
  EXPECT_LT((turn * up - up).norm(), 1e-12);
}

TEST(YawAlignment, FailsWhereNoPointIsOffTheGround) {
  Rng rng = test::test_rng();
  test::StreetEstimate street = test::street_estimate(3);
  const auto none = std::make_shared<const Cloud>(Points{}, StreamKey(1));
  street.estimate.target_ground = street.estimate.source_ground =
      std::make_shared<const GroundSplit>(GroundSplit{{}, none});
  EXPECT_THROW(test::stage<Step>(R"({"step": "yaw_alignment"})")->advance(street.estimate, rng),
               StageError);
  EXPECT_NO_THROW(test::stage<Step>(R"({"step": "yaw_alignment", "points": "all"})")
                      ->advance(street.estimate, rng));
}

}  // namespace
}  // namespace croon

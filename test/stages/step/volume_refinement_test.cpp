#include <gtest/gtest.h>

#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"
#include "test/support/street_estimate.hpp"

namespace croon {
namespace {

TEST(VolumeRefinement, NeverOccupiesMoreThanItsStart) {
  const auto step = test::stage<Step>(R"({"step": "volume_refinement", "points": "all"})");
  Rng rng = test::test_rng();
  for (int trial = 0; trial < 5; ++trial) {
    test::StreetEstimate street = test::street_estimate(6);
    street.estimate.T_target_source = test::pose_near(rng, street.truth, 0.1, 0.1);
    const Estimate after = step->advance(street.estimate, rng);
    ASSERT_EQ(after.diagnostics[0].first, "volume_before_m3");
    ASSERT_EQ(after.diagnostics[1].first, "volume_m3");
    EXPECT_LE(after.diagnostics[1].second, after.diagnostics[0].second);
    EXPECT_GT(after.diagnostics[1].second, 0.0);
  }
}

TEST(VolumeRefinement, ComesNearerAcrossTheSurfaces) {
  // A sparse source in a dense target: most leaves are the target's, and the volume has one clear
  // least.
  const auto step = test::stage<Step>(
      R"({"step": "volume_refinement", "points": "all",
          "scorer": {"type": "openvdb_grid", "leaf_size_m": 0.1},
          "search": {"type": "coordinate_scan", "translation_step_m": 0.02,
                     "min_decrease_ratio": 1e-4, "sweeps": 3}})");
  Rng rng = test::test_rng();
  Points dense = test::random_street(rng, 7, 150000, 0.0);
  Points sparse = test::random_street(rng, 7, 5000, 0.0);
  Estimate estimate;
  estimate.target = std::make_shared<const Cloud>(std::move(dense), StreamKey(1));
  estimate.source = std::make_shared<const Cloud>(std::move(sparse), StreamKey(2));
  estimate.T_target_source.translation = {0.08, -0.1, 0.0};
  const Eigen::Vector3d error_m = step->advance(estimate, rng).T_target_source.translation;
  EXPECT_LT(error_m.norm(), 0.05);
}

}  // namespace
}  // namespace croon

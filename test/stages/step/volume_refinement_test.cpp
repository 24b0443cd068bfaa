#include <gtest/gtest.h>

#include "framework/base/error.hpp"
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
  RigidTransform start;
  start.translation = {0.08, -0.1, 0.0};
  const Estimate estimate = test::estimate_of(std::move(dense), std::move(sparse), start);
  const Eigen::Vector3d error_m = step->advance(estimate, rng).T_target_source.translation;
  EXPECT_LT(error_m.norm(), 0.05);
}

TEST(VolumeRefinement, PointsOutsideOfTheOverlapDecideNothing) {
  const auto step = test::stage<Step>(
      R"({"step": "volume_refinement", "points": "all", "overlap_cube_m": 1,
          "search": {"type": "coordinate_scan", "min_decrease_ratio": 0}})");
  Rng rng = test::test_rng();
  const Points target = test::random_street(rng, 8, 20000, 0.0);
  const Points source = test::random_street(rng, 8, 5000, 0.0);
  for (int trial = 0; trial < 5; ++trial) {
    const RigidTransform start = test::pose_near(rng, {}, 0.5, 0.05);
    // A street as large as the other, above it: its leaves differ from pose to pose.
    Points more = source;
    for (const Eigen::Vector3f& point : test::random_street(rng, 9, 20000, 0.0)) {
      more.push_back(point + Eigen::Vector3f(0.0F, 0.0F, 500.0F));
    }
    const Estimate alone = step->advance(test::estimate_of(target, source, start), rng);
    const Estimate with_more = step->advance(test::estimate_of(target, more, start), rng);
    EXPECT_EQ(with_more.T_target_source.translation, alone.T_target_source.translation);
    EXPECT_EQ(with_more.diagnostics, alone.diagnostics);
  }
}

TEST(VolumeRefinement, FailsWithoutAnOverlap) {
  const auto step =
      test::stage<Step>(R"({"step": "volume_refinement", "points": "all", "overlap_cube_m": 1})");
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 300, 1.0);
  const RigidTransform far{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 100, 0)};
  EXPECT_THROW(step->advance(test::estimate_of(cloud, cloud, far), rng), StageError);
}

}  // namespace
}  // namespace croon

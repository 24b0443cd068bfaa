#include "framework/spatial/ground_candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(GroundCandidates, HaveTheRoadFirstHoweverTheSensorIsTurned) {
  Rng rng = test::test_rng();
  for (std::uint64_t i = 0; i < 10; ++i) {
    const RigidTransform T = {test::random_pose(rng, 0.0).rotation, Eigen::Vector3d::Zero()};
    const Points cloud = transformed(test::random_street(rng, i, 8000, 0.01), T);
    const std::vector<GroundCandidate> found = ground_candidates(cloud, {}, rng);
    ASSERT_FALSE(found.empty());
    const Eigen::Vector3d up = T.rotation.col(2);
    EXPECT_GT(found[0].plane.normal.dot(up), std::cos(rad_from_deg(1.0))) << "street " << i;
    EXPECT_NEAR(found[0].plane.offset_m, 2.0, 0.05);
  }
}

TEST(GroundCandidates, FaceTheSensorAndComeBestFirst) {
  Rng rng = test::test_rng(2);
  GroundCandidateOptions options;
  options.candidates = 5;
  options.max_gap = 10.0;
  const std::vector<GroundCandidate> found =
      ground_candidates(test::random_street(rng, 3, 8000, 0.01), options, rng);
  ASSERT_GE(found.size(), 2U);
  EXPECT_LE(found.size(), 5U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_GE(found[i].plane.offset_m, options.min_height_m);
    EXPECT_LE(found[i].plane.offset_m, options.max_height_m);
    if (i > 0) {
      EXPECT_LE(found[i].score, found[i - 1].score);
    }
  }
}

TEST(GroundCandidates, DropPlanesThatAreFarLessPlausible) {
  GroundCandidateOptions options;
  options.candidates = 5;
  Rng street_rng = test::test_rng(4);
  const Points cloud = test::random_street(street_rng, 3, 8000, 0.01);
  std::size_t before = 0;
  for (const double gap : {0.0, 0.6, 10.0}) {
    options.max_gap = gap;
    Rng rng = test::test_rng(5);
    const std::vector<GroundCandidate> found = ground_candidates(cloud, options, rng);
    ASSERT_FALSE(found.empty());
    EXPECT_GE(found.back().score, found.front().score - gap);
    EXPECT_GE(found.size(), before);
    before = found.size();
  }
  EXPECT_GE(before, 2U);
}

TEST(GroundCandidates, AreNoneInACloudWithoutAPlane) {
  Rng rng = test::test_rng(3);
  EXPECT_TRUE(ground_candidates({}, {}, rng).empty());
  EXPECT_TRUE(ground_candidates(Points(100, Eigen::Vector3f(1, 2, 3)), {}, rng).empty());
}

}  // namespace
}  // namespace croon

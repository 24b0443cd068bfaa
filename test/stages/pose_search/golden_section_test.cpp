#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/stage/pose_search.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

constexpr const char* kAllSix = R"({"type": "golden_section", "sweeps": 20,
    "dofs": ["roll", "pitch", "yaw", "x", "y", "z"], "min_decrease_ratio": 0})";

/// A bowl over all six with its least at `least`.
PoseCost bowl(const RigidTransform& least) {
  return [=](const RigidTransform& pose) {
    const PoseError error = pose_error(pose, least);
    return 1.0 + 100.0 * error.dof.head<3>().squaredNorm() + error.dof.tail<3>().squaredNorm();
  };
}

TEST(GoldenSection, FindsTheLeastCostOfABowl) {
  const auto search = test::stage<PoseSearch>(kAllSix);
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const RigidTransform least = test::random_pose(rng, 5.0);
    const RigidTransform start = test::pose_near(rng, least, 0.5, 0.03);
    const PoseMinimum minimum = search->minimise(bowl(least), start);
    const PoseError error = pose_error(minimum.pose, least);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.05);
    EXPECT_LT(error.translation_m, 0.003);
    EXPECT_EQ(minimum.cost, bowl(least)(minimum.pose));
  }
}

TEST(GoldenSection, ShortensTheIntervalByTheGoldenRatio) {
  const auto search = test::stage<PoseSearch>(
      R"({"type": "golden_section", "dofs": ["x"], "translation_range_m": 0.5,
          "translation_tolerance_m": 0.01})");
  // An interval of 1 m is below 1 cm after ten evaluations that shorten it: 0.618^10 = 0.0081.
  const PoseMinimum minimum = search->minimise(bowl({}), {});
  EXPECT_EQ(minimum.evaluations, 1 + 2 + 10);
}

TEST(GoldenSection, StaysWhereNoPoseIsBetter) {
  const auto search = test::stage<PoseSearch>(R"({"type": "golden_section"})");
  const auto flat = [](const RigidTransform&) { return 3.0; };
  Rng rng = test::test_rng();
  const RigidTransform start = test::random_pose(rng, 5.0);
  const PoseMinimum minimum = search->minimise(PoseCost(flat), start);
  EXPECT_EQ(minimum.pose.translation, start.translation);
  EXPECT_EQ(minimum.pose.rotation, start.rotation);
  EXPECT_EQ(minimum.cost, 3.0);
}

TEST(GoldenSection, MovesTheListedDegreesOfFreedomAlone) {
  const auto search = test::stage<PoseSearch>(
      R"({"type": "golden_section", "dofs": ["y"], "min_decrease_ratio": 0})");
  Rng rng = test::test_rng(2);
  const RigidTransform least = test::random_pose(rng, 5.0);
  const RigidTransform start = test::pose_near(rng, least, 0.0, 0.03);
  const PoseMinimum minimum = search->minimise(bowl(least), start);
  EXPECT_EQ(minimum.pose.translation.x(), start.translation.x());
  EXPECT_EQ(minimum.pose.translation.z(), start.translation.z());
  EXPECT_NEAR(minimum.pose.translation.y(), least.translation.y(), 0.001);
}

}  // namespace
}  // namespace croon

#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/stage/pose_search.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

/// A valley over all six degrees of freedom with its least at `least`: a turn and a shift trade off
/// against each other, so that no single one of them leads down far.
double valley(const RigidTransform& pose, const RigidTransform& least) {
  const Vector6d error = pose_error(pose, least).dof;
  const double across = 3.0 * error(2) - error(3) + 0.5 * error(4);
  return 1.0 + 30.0 * across * across + 10.0 * error.head<3>().squaredNorm() +
         error.tail<3>().squaredNorm();
}

TEST(Bobyqa, FindsTheLeastCostOfAValley) {
  const auto search = test::stage<PoseSearch>(R"({"type": "bobyqa", "tolerance_ratio": 1e-4})");
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const RigidTransform least = test::random_pose(rng, 5.0);
    const RigidTransform start = test::pose_near(rng, least, 0.5, 0.04);
    const auto cost = [&](const RigidTransform& pose) { return valley(pose, least); };
    const PoseMinimum minimum = search->minimise(PoseCost(cost), start);
    const PoseError error = pose_error(minimum.pose, least);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.05);
    EXPECT_LT(error.translation_m, 0.003);
    EXPECT_EQ(minimum.cost, cost(minimum.pose));
    EXPECT_LT(minimum.evaluations, 500);
  }
}

TEST(Bobyqa, FindsTheLeastOfACostInSteps) {
  // As a volume is: it differs from pose to pose by whole leaves.
  const auto search = test::stage<PoseSearch>(R"({"type": "bobyqa"})");
  Rng rng = test::test_rng();
  for (int i = 0; i < 30; ++i) {
    const RigidTransform least = test::random_pose(rng, 5.0);
    const RigidTransform start = test::pose_near(rng, least, 0.3, 0.05);
    const auto cost = [&](const RigidTransform& pose) {
      return std::floor(valley(pose, least) * 1e6) / 1e6;
    };
    const PoseMinimum minimum = search->minimise(PoseCost(cost), start);
    EXPECT_LT(pose_error(minimum.pose, least).translation_m, 0.02);
    EXPECT_LT(minimum.cost, cost(start));
  }
}

TEST(Bobyqa, StaysInTheRangesAndMovesTheListedDegreesOfFreedomAlone) {
  const auto search = test::stage<PoseSearch>(
      R"({"type": "bobyqa", "dofs": ["y", "z"], "translation_range_m": 0.05})");
  Rng rng = test::test_rng();
  for (int i = 0; i < 20; ++i) {
    const RigidTransform start = test::random_pose(rng, 5.0);
    const Eigen::Vector3d least = start.translation + Eigen::Vector3d(0.2, 0.2, -0.01);
    const auto cost = [&](const RigidTransform& pose) {
      const Eigen::Array3d offset = (pose.translation - start.translation).array().abs();
      EXPECT_LE(offset.maxCoeff(), 0.05 + 1e-12);
      EXPECT_EQ(pose.rotation, start.rotation);
      return (pose.translation - least).squaredNorm();
    };
    const PoseMinimum minimum = search->minimise(PoseCost(cost), start);
    EXPECT_EQ(minimum.pose.translation.x(), start.translation.x());
    EXPECT_NEAR(minimum.pose.translation.y(), start.translation.y() + 0.05, 1e-9);
    EXPECT_NEAR(minimum.pose.translation.z(), start.translation.z() - 0.01, 1e-3);
  }
}

TEST(Bobyqa, StaysWhereNoPoseIsBetter) {
  const auto search = test::stage<PoseSearch>(R"({"type": "bobyqa"})");
  Rng rng = test::test_rng();
  const RigidTransform start = test::random_pose(rng, 5.0);
  const auto flat = [](const RigidTransform&) { return 3.0; };
  const PoseMinimum minimum = search->minimise(PoseCost(flat), start);
  EXPECT_EQ(minimum.pose.translation, start.translation);
  EXPECT_EQ(minimum.pose.rotation, start.rotation);
  EXPECT_EQ(minimum.cost, 3.0);
  const auto demanding =
      test::stage<PoseSearch>(R"({"type": "bobyqa", "min_decrease_ratio": 0.5})");
  const auto cost = [&](const RigidTransform& pose) {
    return 1.0 + (pose.translation - start.translation).x();
  };
  EXPECT_EQ(demanding->minimise(PoseCost(cost), start).pose.translation, start.translation);
}

TEST(Bobyqa, EvaluatesNoMoreThanItMay) {
  const auto search = test::stage<PoseSearch>(R"({"type": "bobyqa", "max_evaluations": 20})");
  int evaluations = 0;
  const auto cost = [&](const RigidTransform& pose) {
    ++evaluations;
    return valley(pose, {});
  };
  const PoseMinimum minimum = search->minimise(PoseCost(cost), {});
  EXPECT_LE(evaluations, 20);
  EXPECT_EQ(minimum.evaluations, evaluations);
}

TEST(Bobyqa, AnExceptionOfTheCostReachesTheCaller) {
  const auto search = test::stage<PoseSearch>(R"({"type": "bobyqa"})");
  int evaluations = 0;
  const auto cost = [&](const RigidTransform&) -> double {
    if (++evaluations == 7) throw StageError("outside of the grid");
    return 1.0;
  };
  EXPECT_THROW(search->minimise(PoseCost(cost), {}), StageError);
  EXPECT_EQ(evaluations, 7);
}

}  // namespace
}  // namespace croon

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/stage/pose_search.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

bool same_bits(const RigidTransform& a, const RigidTransform& b) {
  return a.rotation == b.rotation && a.translation == b.translation;
}

/// The start's offset that `pose` is at.
Vector6d offset_from(const RigidTransform& start, const RigidTransform& pose) {
  return pose_error(pose, start).dof;
}

/// A bowl over (x, y) with its least `least_m` from the start.
PoseCost planar_bowl(const RigidTransform& start, const Eigen::Vector2d& least_m) {
  return [=](const RigidTransform& pose) {
    return 1.0 + ((pose.translation - start.translation).head<2>() - least_m).squaredNorm();
  };
}

TEST(CoordinateScan, AuthorsSettingsStepAlongXThenY) {
  const auto search = test::stage<PoseSearch>(
      R"({"type": "coordinate_scan", "translation_step_m": 0.02, "min_decrease_ratio": 0})");
  Rng rng = test::test_rng();
  for (int i = 0; i < 200; ++i) {
    const RigidTransform start = test::random_pose(rng, 5.0);
    const Eigen::Vector2d least_m{rng.uniform(-0.25, 0.25), rng.uniform(-0.25, 0.25)};
    const PoseMinimum minimum = search->minimise(planar_bowl(start, least_m), start);
    for (int k = 0; k < 2; ++k) {
      const double steps = std::round((minimum.pose.translation - start.translation)(k) / 0.02);
      const double expected = std::min(9.0, std::max(-9.0, std::round(least_m(k) / 0.02)));
      EXPECT_EQ(steps, expected);
    }
    EXPECT_LT((offset_from(start, minimum.pose).head<3>()).norm(), 1e-12);
    EXPECT_EQ(minimum.pose.translation.z(), start.translation.z());
  }
}

TEST(CoordinateScan, LooksToBothSidesAsFarAsTheCostFalls) {
  const auto search = test::stage<PoseSearch>(
      R"({"type": "coordinate_scan", "dofs": ["x"], "translation_step_m": 0.02,
          "min_decrease_ratio": 1e-4})");
  const auto evaluations = [&](double least_m) {
    return search->minimise(planar_bowl({}, {least_m, 0.0}), {}).evaluations;
  };
  // Three steps and the one that rises; then one to the other side.
  EXPECT_EQ(evaluations(0.06), 1 + (3 + 1) + 1);
  EXPECT_EQ(evaluations(-0.06), 1 + 1 + (3 + 1));
  EXPECT_EQ(evaluations(1.0), 1 + 9 + 1);
  EXPECT_EQ(evaluations(0.0), 1 + 1 + 1);
}

TEST(CoordinateScan, TakesNoStepThatLowersTheCostTooLittle) {
  const auto slope = [](double per_step) {
    return [per_step](const RigidTransform& pose) {
      return 1.0 - per_step * pose.translation.x() / 0.02;
    };
  };
  const auto search = test::stage<PoseSearch>(
      R"({"type": "coordinate_scan", "dofs": ["x"], "translation_step_m": 0.02,
          "min_decrease_ratio": 1e-4})");
  EXPECT_TRUE(same_bits(search->minimise(slope(0.9e-4), {}).pose, {}));
  EXPECT_NEAR(search->minimise(slope(1.1e-4), {}).pose.translation.x(), 9 * 0.02, 1e-12);
}

TEST(CoordinateScan, FindsTheLeastOverAllDegreesOfFreedom) {
  const auto search = test::stage<PoseSearch>(
      R"({"type": "coordinate_scan", "dofs": ["yaw", "x", "y", "z", "pitch", "roll"],
          "translation_step_m": 0.1, "rotation_step_deg": 2, "min_decrease_ratio": 0,
          "sweeps": 20, "halvings": 8})");
  Rng rng = test::test_rng(2);
  for (int i = 0; i < 50; ++i) {
    const RigidTransform start = test::random_pose(rng, 5.0);
    const RigidTransform least = test::pose_near(rng, start, 5.0, 0.3);
    const PoseCost cost = [&](const RigidTransform& pose) {
      const PoseError error = pose_error(pose, least);
      return error.rotation_rad * error.rotation_rad + error.translation_m * error.translation_m;
    };
    const PoseMinimum minimum = search->minimise(cost, start);
    const PoseError error = pose_error(minimum.pose, least);
    EXPECT_LT(error.translation_m, 0.1 / 256);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 2.0 / 256);
    EXPECT_EQ(minimum.cost, cost(minimum.pose));
  }
}

TEST(CoordinateScan, LookingAtTheWholeRangeGetsOverARise) {
  const PoseCost two_bowls = [](const RigidTransform& pose) {
    const double x = pose.translation.x();
    return 1.0 + std::min(std::abs(x), std::abs(x - 0.14) - 0.02);
  };
  const auto at = [&](const std::string& stop) {
    return test::stage<PoseSearch>(
               R"({"type": "coordinate_scan", "translation_step_m": 0.02, "stop": ")" + stop +
               R"("})")
        ->minimise(two_bowls, {})
        .pose.translation.x();
  };
  EXPECT_EQ(at("first_rise"), 0.0);
  EXPECT_NEAR(at("never"), 0.14, 1e-12);
}

TEST(CoordinateScan, WholeRangeAgreesWithEveryPoseOfTheGrid) {
  Rng rng = test::test_rng(3);
  const auto search = test::stage<PoseSearch>(
      R"({"type": "coordinate_scan", "dofs": ["yaw"], "rotation_step_deg": 0.5, "max_steps": 20,
          "stop": "never", "min_decrease_ratio": 0})");
  for (int i = 0; i < 100; ++i) {
    const RigidTransform start = test::random_pose(rng, 5.0);
    const double frequency = rng.uniform(10.0, 60.0), phase = rng.uniform(0.0, 2 * kPi);
    const PoseCost cost = [&](const RigidTransform& pose) {
      return 2.0 + std::sin(frequency * offset_from(start, pose)(2) + phase);
    };
    double least = cost(start);
    for (int k = -20; k <= 20; ++k) {
      Vector6d offset = Vector6d::Zero();
      offset(2) = k * rad_from_deg(0.5);
      least = std::min(least, cost(moved(start, offset)));
    }
    const PoseMinimum minimum = search->minimise(cost, start);
    EXPECT_EQ(minimum.cost, least);
    EXPECT_EQ(minimum.evaluations, 41);
  }
}

TEST(CoordinateScan, NeverCostsMoreThanTheStartCountsAndIsDeterministic) {
  Rng rng = test::test_rng(4);
  for (const char* stop : {"first_rise", "never"}) {
    const auto search = test::stage<PoseSearch>(
        std::string(R"({"type": "coordinate_scan", "dofs": ["x", "roll", "z"], "sweeps": 3,
          "halvings": 2, "stop": ")") +
        stop + "\"}");
    for (int i = 0; i < 100; ++i) {
      const RigidTransform start = test::random_pose(rng, 5.0);
      const Eigen::Vector3d wave{rng.normal(), rng.normal(), rng.normal()};
      int calls = 0;
      const PoseCost cost = [&](const RigidTransform& pose) {
        ++calls;
        return 2.0 + std::sin(100.0 * wave.dot(pose * Eigen::Vector3d(1.0, 2.0, 3.0)));
      };
      const PoseMinimum minimum = search->minimise(cost, start);
      EXPECT_EQ(minimum.evaluations, calls);
      EXPECT_LE(minimum.cost, cost(start));
      const PoseMinimum again = search->minimise(cost, start);
      EXPECT_TRUE(same_bits(again.pose, minimum.pose));
      EXPECT_EQ(again.cost, minimum.cost);
    }
  }
}

TEST(CoordinateScan, AsksForManyPosesAtOnceAndFindsTheSame) {
  Rng rng = test::test_rng();
  for (const char* stop : {"first_rise", "never"}) {
    const auto search = test::stage<PoseSearch>(
        std::string(R"({"type": "coordinate_scan", "dofs": ["x", "y", "yaw"], "stop": ")") + stop +
        "\"}");
    for (int i = 0; i < 50; ++i) {
      const RigidTransform start = test::random_pose(rng, 5.0);
      const Eigen::Vector2d least_m{rng.uniform(-0.05, 0.05), rng.uniform(-0.05, 0.05)};
      const PoseCost one_by_one = planar_bowl(start, least_m);
      int calls = 0;
      std::size_t most = 0;
      const PoseCost many(
          [&](const RigidTransform& pose) {
            ++calls;
            return one_by_one(pose);
          },
          [&](const std::vector<RigidTransform>& poses) {
            calls += static_cast<int>(poses.size());
            most = std::max(most, poses.size());
            return one_by_one.at(poses);
          });
      const PoseMinimum minimum = search->minimise(many, start);
      const PoseMinimum expected = search->minimise(one_by_one, start);
      EXPECT_TRUE(same_bits(minimum.pose, expected.pose));
      EXPECT_EQ(minimum.cost, expected.cost);
      EXPECT_EQ(minimum.evaluations, calls);
      EXPECT_EQ(most, stop == std::string("never") ? 18U : 2U);
    }
  }
}

TEST(CoordinateScan, ReturnsTheStartItselfWhereNothingIsLower) {
  Rng rng = test::test_rng(5);
  const auto search = test::stage<PoseSearch>(
      R"({"type": "coordinate_scan", "dofs": ["x", "yaw"], "sweeps": 5, "halvings": 1})");
  const RigidTransform start = test::random_pose(rng, 5.0);
  const PoseMinimum minimum = search->minimise([](const RigidTransform&) { return 3.0; }, start);
  EXPECT_TRUE(same_bits(minimum.pose, start));
  // One pass of two scans to both sides, for each of the two step sizes.
  EXPECT_EQ(minimum.evaluations, 1 + 2 * 4);
}

}  // namespace
}  // namespace croon

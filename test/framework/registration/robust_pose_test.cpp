#include "framework/registration/robust_pose.hpp"

#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

Eigen::Vector3f noise(Rng& rng, double std_m) {
  return (std_m * Eigen::Vector3d{rng.normal(), rng.normal(), rng.normal()}).cast<float>();
}

TEST(RobustPose, IsExactWithoutNoise) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 20; ++i) {
    const RigidTransform T = test::random_pose(rng, 10.0);
    const Points source = test::random_cloud(rng, 3 + i, 20.0);
    const PoseError error = pose_error(robust_pose(transformed(source, T), source, 0.2), T);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 1e-3);
    EXPECT_LT(error.translation_m, 1e-4);
  }
}

TEST(RobustPose, IsHardlyMovedByWrongCorrespondences) {
  Rng rng = test::test_rng(2);
  for (int i = 0; i < 20; ++i) {
    const RigidTransform T = test::random_pose(rng, 10.0);
    const Points source = test::random_cloud(rng, 60, 20.0);
    Points target = transformed(source, T);
    for (std::size_t k = 0; k < target.size(); ++k) {
      target[k] += noise(rng, 0.05);
      if (k % 3 == 0) target[k] = test::random_cloud(rng, 1, 20.0).front();
    }
    const PoseError error = pose_error(robust_pose(target, source, 0.15), T);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.3) << i;
    EXPECT_LT(error.translation_m, 0.05) << i;
  }
}

TEST(RobustPose, NeedsPointsOffOneLine) {
  Rng rng = test::test_rng(3);
  const RigidTransform T = test::random_pose(rng, 5.0);
  EXPECT_THROW(robust_pose({}, {}, 0.2), StageError);
  Points line;
  for (int i = 0; i < 20; ++i) line.push_back(static_cast<float>(i) * Eigen::Vector3f(1, 2, 3));
  EXPECT_THROW(robust_pose(transformed(line, T), line, 0.2), StageError);
  EXPECT_THROW(robust_pose(Points(5, {1, 2, 3}), Points(5, {1, 2, 3}), 0.2), StageError);
}

TEST(MostVoted, IsTheMeanOfTheDensestInterval) {
  EXPECT_DOUBLE_EQ(most_voted({7.0}, 0.1), 7.0);
  EXPECT_DOUBLE_EQ(most_voted({-50.0, 1.0, 1.1, 1.2, 40.0, 40.1, 300.0}, 0.1), 1.1);
  Rng rng = test::test_rng(4);
  std::vector<double> values;
  for (int i = 0; i < 100; ++i) values.push_back(rng.uniform(-10.0, 10.0));
  for (int i = 0; i < 40; ++i) values.push_back(3.0 + 0.05 * rng.normal());
  EXPECT_NEAR(most_voted(values, 0.15), 3.0, 0.05);
}

}  // namespace
}  // namespace croon

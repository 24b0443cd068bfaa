#include "framework/geometry/rigid_transform.hpp"

#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(RigidTransform, InverseUndoesAndFramesCancel) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 1000; ++i) {
    const RigidTransform T_a_b = test::random_pose(rng, 10.0);
    const RigidTransform T_b_c = test::random_pose(rng, 10.0);
    const Eigen::Vector3d point{rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-5, 5)};
    EXPECT_LT((T_a_b.inverse() * (T_a_b * point) - point).norm(), 1e-12);
    EXPECT_LT(((T_a_b * T_b_c) * point - T_a_b * (T_b_c * point)).norm(), 1e-12);
  }
}

TEST(RigidTransform, RollPitchYawThereAndBack) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d rpy{rng.uniform(-kPi, kPi), rng.uniform(-kPi / 2, kPi / 2),
                              rng.uniform(-kPi, kPi)};
    EXPECT_LT((rpy_from_rotation(rotation_from_rpy(rpy)) - rpy).norm(), 1e-9);
    const RigidTransform T = test::random_pose(rng, 1.0);
    EXPECT_LT((rotation_from_rpy(rpy_from_rotation(T.rotation)) - T.rotation).norm(), 1e-12);
  }
}

TEST(RigidTransform, StraightUpKeepsTheRotation) {
  const Eigen::Matrix3d R = rotation_from_rpy({0.3, kPi / 2, -1.2});
  EXPECT_LT((rotation_from_rpy(rpy_from_rotation(R)) - R).norm(), 1e-9);
}

TEST(RigidTransform, RotationBetweenTurnsOneIntoTheOther) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d from = test::random_pose(rng, 1.0).rotation.col(0);
    const Eigen::Vector3d other = test::random_pose(rng, 1.0).rotation.col(1);
    const Eigen::Vector3d to = i % 10 == 0 ? Eigen::Vector3d(-from) : other;
    const Eigen::Matrix3d R = rotation_between(from, to);
    EXPECT_LT((R * from - to).norm(), 1e-7);
    EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    EXPECT_NEAR(R.determinant(), 1.0, 1e-9);
  }
}

TEST(RigidTransform, AngleOfTheSmallestRotations) {
  for (const double angle : {1e-12, 1e-8, 1e-3, 1.0, 3.1}) {
    EXPECT_NEAR(rotation_angle(rotation_exp(angle * Eigen::Vector3d::UnitY())), angle,
                1e-14 + 1e-12 * angle);
  }
}

TEST(RigidTransform, KnowsARotationFromOtherMatrices) {
  Rng rng = test::test_rng(7);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Matrix3d R = test::random_pose(rng, 1.0).rotation;
    EXPECT_TRUE(is_rotation_matrix(R));
    EXPECT_TRUE(is_rotation_matrix(R.cast<float>().cast<double>()));
    EXPECT_FALSE(is_rotation_matrix(-R));
    EXPECT_FALSE(is_rotation_matrix(1.001 * R));
    EXPECT_FALSE(is_rotation_matrix(R * Eigen::Vector3d(1.0, 1.001, 1.0).asDiagonal()));
  }
}

TEST(PoseError, IsTheOffsetThatAStartWasMovedBy) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 1000; ++i) {
    const RigidTransform truth = test::random_pose(rng, 3.0);
    Vector6d offset;
    for (int k = 0; k < 6; ++k) offset(k) = rng.uniform(-0.7, 0.7);
    const PoseError error = pose_error(moved(truth, offset), truth);
    EXPECT_LT((error.dof - offset).norm(), 1e-9);
    EXPECT_NEAR(error.translation_m, offset.tail<3>().norm(), 1e-12);
  }
}

TEST(Stepped, TurnsAboutTheOwnOriginAndIsUndoneByTheOppositeStep) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 200; ++i) {
    const RigidTransform T = test::random_pose(rng, 10.0);
    Vector6d step;
    for (double& part : step) part = rng.uniform(-0.2, 0.2);
    const RigidTransform after = stepped(T, step);
    EXPECT_NEAR(pose_error(after, T).rotation_rad, step.head<3>().norm(), 1e-9);
    EXPECT_LT((after.translation - T.translation - step.tail<3>()).norm(), 1e-12);
    EXPECT_LT(pose_error(stepped(after, -step), T).rotation_rad, 1e-7);
    // A long step is cut to half a radian as a whole.
    const RigidTransform far = stepped(T, 10.0 / step.head<3>().norm() * step);
    EXPECT_NEAR(pose_error(far, T).rotation_rad, 0.5, 1e-9);
  }
}

}  // namespace
}  // namespace croon

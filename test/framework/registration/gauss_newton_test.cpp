#include "framework/registration/gauss_newton.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(PointJacobian, IsTheDerivativeOfTheMovedPoint) {
  Rng rng = test::test_rng();
  for (int trial = 0; trial < 100; ++trial) {
    const RigidTransform T = test::random_pose(rng, 5.0);
    const Eigen::Vector3d point{rng.uniform(-20, 20), rng.uniform(-20, 20), rng.uniform(-20, 20)};
    const Eigen::Matrix<double, 3, 6> J = point_jacobian(T.rotation * point);
    constexpr double h = 1e-6;
    for (int k = 0; k < 6; ++k) {
      const Vector6d step = h * Vector6d::Unit(k);
      const Eigen::Vector3d derivative =
          (moved(T, step) * point - moved(T, -step) * point) / (2 * h);
      EXPECT_LT((derivative - J.col(k)).norm(), 1e-6);
    }
  }
}

TEST(NormalEquations, StepSolvesALinearProblem) {
  Rng rng = test::test_rng();
  const Vector6d expected = test::pose_vector(rng);
  NormalEquations equations;
  for (int i = 0; i < 50; ++i) {
    Vector6d J;
    for (int k = 0; k < 6; ++k) J(k) = rng.normal();
    equations.add(J, -J.dot(expected), rng.uniform(0.1, 1.0));
  }
  EXPECT_LT((equations.step() - expected).norm(), 1e-9);
}

TEST(NormalEquations, ScalarAndVectorResidualsAgree) {
  Rng rng = test::test_rng();
  NormalEquations scalars;
  NormalEquations vectors;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d arm{rng.normal(), rng.normal(), rng.normal()};
    const Eigen::Vector3d r{rng.normal(), rng.normal(), rng.normal()};
    const Eigen::Matrix<double, 3, 6> J = point_jacobian(arm);
    for (int k = 0; k < 3; ++k) scalars.add(J.row(k).transpose(), r(k), 0.7);
    vectors.add(J, r, Eigen::Matrix3d::Identity(), 0.7);
  }
  EXPECT_LT((scalars.full_information() - vectors.full_information()).norm(), 1e-9);
  EXPECT_LT((scalars.gradient - vectors.gradient).norm(), 1e-9);
  EXPECT_NEAR(scalars.weighted_square_sum, vectors.weighted_square_sum, 1e-9);
}

TEST(NormalEquations, DoesNotMoveWhereTheSceneIsOpen) {
  // One plane across z: x, y and yaw are open.
  Rng rng = test::test_rng();
  NormalEquations equations;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d arm{rng.uniform(-5, 5), rng.uniform(-5, 5), 0.0};
    Vector6d J;
    J << arm.cross(Eigen::Vector3d::UnitZ()), Eigen::Vector3d::UnitZ();
    equations.add(J, 0.1, 1.0);
  }
  const Vector6d step = equations.step();
  EXPECT_NEAR(step(5), -0.1, 1e-9);
  EXPECT_LT(std::abs(step(2)) + std::abs(step(3)) + std::abs(step(4)), 1e-9);
}

}  // namespace
}  // namespace croon

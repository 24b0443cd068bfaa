#include "framework/geometry/pose_covariance.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

using test::random_covariance;

TEST(PoseCovariance, EveryProductOfAMatrixAndItsTransposeIsOne) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 200; ++i) EXPECT_TRUE(is_covariance(random_covariance(rng).matrix));
  EXPECT_TRUE(is_covariance(Matrix6d::Zero()));
  // Of rank one.
  const Vector6d direction = test::pose_vector(rng);
  EXPECT_TRUE(is_covariance(direction * direction.transpose()));
}

TEST(PoseCovariance, IsSymmetricFiniteBoundedAndNotNegative) {
  Rng rng = test::test_rng(2);
  const Matrix6d good = random_covariance(rng).matrix;
  const auto is_one_with = [&](int i, int j, double value) {
    Matrix6d matrix = good;
    matrix(i, j) = matrix(j, i) = value;
    return is_covariance(matrix);
  };
  Matrix6d skew = good;
  skew(0, 3) += 1e-18 + 1e-12 * std::abs(skew(0, 3));
  EXPECT_FALSE(is_covariance(skew));
  EXPECT_FALSE(is_one_with(1, 1, -1e-9));
  EXPECT_FALSE(is_one_with(2, 2, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(is_one_with(2, 3, std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(is_one_with(4, 4, 2.0 * kMaxVariance));
  EXPECT_FALSE(is_one_with(0, 1, 2.0 * std::sqrt(good(0, 0) * good(1, 1))));
  EXPECT_FALSE(is_one_with(5, 5, 0.0));  // Others still vary with it.
  // Every pair may vary together, but not all three.
  Matrix6d three = Matrix6d::Identity();
  for (const auto& [i, j] : {std::pair(0, 1), {1, 2}, {0, 2}}) three(i, j) = three(j, i) = -0.9;
  EXPECT_FALSE(is_covariance(three));
}

TEST(PoseCovariance, OfAMeanOfManyFallsWithTheirNumber) {
  Rng rng = test::test_rng(3);
  PoseCovariance one = random_covariance(rng);
  one.dofs = {};
  std::vector<PoseCovariance> four(4, one);
  four[2].dofs[3] = Observability::weak;
  const PoseCovariance mean = covariance_of_mean(four);
  EXPECT_LT((4.0 * mean.matrix - one.matrix).norm(), 1e-12 * one.matrix.norm());
  EXPECT_EQ(mean.dofs[3], Observability::weak);
  EXPECT_EQ(mean.dofs[0], Observability::determined);
  EXPECT_LT((mean_covariance(four).matrix - one.matrix).norm(), 1e-12 * one.matrix.norm());
  EXPECT_THROW(covariance_of_mean({}), std::logic_error);
}

TEST(PoseCovariance, OfAComposedPoseFollowsBothErrors) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 20; ++i) {
    const RigidTransform T_a_b = test::random_pose(rng, 5.0), T_b_c = test::random_pose(rng, 5.0);
    const Vector6d first = 1e-5 * test::pose_vector(rng), second = 1e-5 * test::pose_vector(rng);
    const Vector6d error =
        pose_error(moved(T_a_b, first) * moved(T_b_c, second), T_a_b * T_b_c).dof;
    const PoseCovariance composed =
        composed_covariance(T_a_b, {first * first.transpose(), {}}, T_b_c, {});
    const PoseCovariance other =
        composed_covariance(T_a_b, {}, T_b_c, {second * second.transpose(), {}});
    // The errors add, and the covariance of a fixed error is its square.
    const Vector6d along = pose_error(moved(T_a_b, first) * T_b_c, T_a_b * T_b_c).dof;
    const Vector6d across = pose_error(T_a_b * moved(T_b_c, second), T_a_b * T_b_c).dof;
    EXPECT_LT((along + across - error).norm(), 1e-3 * error.norm());
    EXPECT_LT((composed.matrix - along * along.transpose()).norm(), 1e-3 * along.squaredNorm());
    EXPECT_LT((other.matrix - across * across.transpose()).norm(), 1e-3 * across.squaredNorm());
  }
}

TEST(PoseCovariance, IsBoundedByAnUnknownPose) {
  Rng rng = test::test_rng(4);
  for (int i = 0; i < 200; ++i) {
    // A direction that nothing holds hides the others: none may come out as perfectly known.
    const Vector6d direction = test::pose_vector(rng);
    const Matrix6d known = random_covariance(rng).matrix;
    const Matrix6d bounded = bounded_covariance(known + 1e18 * direction * direction.transpose());
    EXPECT_TRUE(is_covariance(bounded));
    for (int dof = 0; dof < 6; ++dof) {
      EXPECT_LE(bounded(dof, dof), unknown_variances()(dof) * (1.0 + 1e-9));
      EXPECT_GE(bounded(dof, dof), 1e-6 * unknown_variances()(dof));
    }
  }
  const Matrix6d small = 1e-6 * Matrix6d::Identity();
  EXPECT_LT((bounded_covariance(small) - small).norm(), 1e-5 * small.norm());
}

TEST(PoseCovariance, WordsHaveNames) {
  for (const Observability word : kObservabilities) {
    EXPECT_EQ(observability_of(name_of(word)), word);
  }
  EXPECT_FALSE(observability_of("certain"));
}

}  // namespace
}  // namespace croon

#include "framework/geometry/guarded_inverse.hpp"

#include <gtest/gtest.h>

#include "framework/geometry/dof.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

TEST(GuardedInverse, IsTheInverseOfPositiveMatrices) {
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    const Matrix6d matrix = test::random_covariance(rng).matrix;
    const Matrix6d inverse = guarded_inverse<6>(matrix);
    EXPECT_TRUE((inverse * matrix).isApprox(Matrix6d::Identity(), 1e-6));
    EXPECT_EQ(inverse, inverse.transpose());
  }
}

TEST(GuardedInverse, DoesNotDependOnUnits) {
  Rng rng = test::test_rng(2);
  const Matrix6d matrix = test::random_covariance(rng).matrix;
  Vector6d units;
  units << 1, 10, 100, 1e-3, 1e3, 1;
  const Matrix6d scaled = units.asDiagonal() * matrix * units.asDiagonal();
  const Matrix6d expected = units.cwiseInverse().asDiagonal() * guarded_inverse<6>(matrix) *
                            units.cwiseInverse().asDiagonal();
  EXPECT_TRUE(guarded_inverse<6>(scaled).isApprox(expected, 1e-9));
}

TEST(GuardedInverse, IsFiniteAndPositiveWithoutInformation) {
  Matrix6d matrix = Matrix6d::Identity();
  matrix(5, 5) = -3.0;
  matrix(4, 4) = 0.0;
  const Matrix6d inverse = guarded_inverse<6>(matrix);
  EXPECT_TRUE(inverse.allFinite());
  EXPECT_GT(inverse(4, 4), 1e6);
  EXPECT_GT(inverse(5, 5), 1e6);
  EXPECT_NEAR(inverse(0, 0), 1.0, 1e-12);
}

}  // namespace
}  // namespace croon

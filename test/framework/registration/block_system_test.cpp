#include "framework/registration/block_system.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

Eigen::MatrixXd random_matrix(Rng& rng, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (double& element : matrix.reshaped()) element = rng.normal();
  return matrix;
}

TEST(BlockSystem, IsTheDenseAssemblyOfTermsWithRandomBlocks) {
  Rng rng = test::test_rng();
  for (int run = 0; run < 50; ++run) {
    std::vector<Block> all;
    Eigen::Index unknowns = 0;
    for (int i = 0; i < 6; ++i) {
      all.push_back(appended_block(static_cast<Eigen::Index>(rng.below(4)), unknowns));
    }
    BlockSystem system = BlockSystem::zero(unknowns);
    BlockSystem expected = system;
    for (int n = 0; n < 20; ++n) {
      // Four residuals that depend on three blocks, the Jacobian with three columns for each.
      const std::size_t first = rng.below(4);
      const std::array<Block, 3> blocks = {all[first + 2], all[first], all[first + 1]};
      const std::array<int, 3> from = {0, 3, 6};
      const Eigen::MatrixXd J = random_matrix(rng, 4, 9), r = random_matrix(rng, 4, 1);
      const Eigen::VectorXd gradient = J.transpose() * r;
      const Eigen::MatrixXd hessian = J.transpose() * J;
      system.add(blocks, from, gradient, hessian);
      Eigen::MatrixXd dense_J = Eigen::MatrixXd::Zero(4, unknowns);
      for (std::size_t i = 0; i < 3; ++i) {
        dense_J.middleCols(blocks[i].at, blocks[i].size) = J.middleCols(from[i], blocks[i].size);
      }
      expected.gradient += dense_J.transpose() * r;
      expected.hessian += dense_J.transpose() * dense_J;
    }
    EXPECT_NEAR((system.hessian - expected.hessian).norm(), 0.0, 1e-12 * expected.hessian.norm());
    EXPECT_NEAR((system.gradient - expected.gradient).norm(), 0.0,
                1e-12 * expected.gradient.norm());
  }
}

TEST(BlockSystem, IgnoresTermsOfConstantBlocks) {
  Eigen::Index unknowns = 0;
  const Block pose = appended_block(6, unknowns), constant = appended_block(0, unknowns);
  EXPECT_EQ(unknowns, 6);
  EXPECT_FALSE(constant);
  BlockSystem system = BlockSystem::zero(unknowns);
  system.add(constant, Eigen::Matrix<double, 6, 1>::Ones());
  system.add(pose, constant, Eigen::Matrix<double, 6, 6>::Ones());
  system.add(constant, pose, Eigen::Matrix<double, 6, 6>::Ones());
  EXPECT_TRUE(system.gradient.isZero(0.0));
  EXPECT_TRUE(system.hessian.isZero(0.0));
}

}  // namespace
}  // namespace croon

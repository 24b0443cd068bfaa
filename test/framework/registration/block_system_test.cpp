#include "framework/registration/block_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <vector>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

Eigen::MatrixXd random_matrix(Rng& rng, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (double& element : matrix.reshaped()) element = rng.normal();
  return matrix;
}

/// Residuals that depend on three of the blocks, and the derivatives of half their squared sum.
struct RandomTerm {
  std::array<Block, 3> blocks;
  std::array<int, 3> from;
  Eigen::MatrixXd J;  ///< With three columns for each block, also for constant ones.
  Eigen::VectorXd r;

  /// The Jacobian with respect to all unknowns.
  Eigen::MatrixXd dense(Eigen::Index unknowns) const {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(J.rows(), unknowns);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      all.middleCols(blocks[i].at, blocks[i].size) = J.middleCols(from[i], blocks[i].size);
    }
    return all;
  }
};

TEST(BlockSystem, IsTheDenseAssemblyOfTermsWithRandomBlocks) {
  Rng rng = test::test_rng();
  for (int run = 0; run < 50; ++run) {
    std::vector<Block> blocks;
    Eigen::Index unknowns = 0;
    for (int i = 0; i < 6; ++i) {
      blocks.push_back(appended_block(static_cast<int>(rng.uniform(0.0, 3.999)), unknowns));
    }
    BlockSystem system = BlockSystem::zero(unknowns), one_by_one = system;
    Eigen::MatrixXd hessian = system.hessian;
    Eigen::VectorXd gradient = system.gradient;
    for (int n = 0; n < 20; ++n) {
      const auto first = static_cast<std::size_t>(rng.uniform(0.0, 3.999));
      const RandomTerm term = {{blocks[first + 2], blocks[first], blocks[first + 1]},
                               {0, 3, 6},
                               random_matrix(rng, 4, 9),
                               random_matrix(rng, 4, 1)};
      const Eigen::MatrixXd of_term = term.J.transpose() * term.J;
      const Eigen::VectorXd slope = term.J.transpose() * term.r;
      system.add(term.blocks, term.from, slope, of_term);
      for (std::size_t i = 0; i < 3; ++i) {
        const Block& a = term.blocks[i];
        one_by_one.add(a, slope.segment(term.from[i], a.size));
        for (std::size_t j = 0; j < 3; ++j) {
          const Block& b = term.blocks[j];
          one_by_one.add(a, b, of_term.block(term.from[i], term.from[j], a.size, b.size));
        }
      }
      const Eigen::MatrixXd J = term.dense(unknowns);
      hessian += J.transpose() * J;
      gradient += J.transpose() * term.r;
    }
    EXPECT_NEAR((system.hessian - hessian).norm(), 0.0, 1e-12 * hessian.norm());
    EXPECT_NEAR((system.gradient - gradient).norm(), 0.0, 1e-12 * gradient.norm());
    EXPECT_EQ(system.hessian, one_by_one.hessian);
    EXPECT_EQ(system.gradient, one_by_one.gradient);
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

TEST(BlockSystem, HasTheSameMinimumAlongOtherUnknowns) {
  Rng rng = test::test_rng();
  for (int run = 0; run < 20; ++run) {
    const Eigen::MatrixXd A = random_matrix(rng, 8, 5), J = random_matrix(rng, 5, 5);
    const BlockSystem system = {random_matrix(rng, 5, 1), A.transpose() * A};
    const BlockSystem other = system.along(J);
    const Eigen::VectorXd expected = system.hessian.ldlt().solve(system.gradient);
    const Eigen::VectorXd found = J * other.hessian.ldlt().solve(other.gradient);
    EXPECT_NEAR((found - expected).norm(), 0.0, 1e-6 * (1.0 + expected.norm()));
  }
}

}  // namespace
}  // namespace croon

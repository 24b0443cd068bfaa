#include "framework/registration/bundle_uncertainty.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

Eigen::MatrixXd normal_matrix(Rng& rng, Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix.data()[i] = rng.normal();
  return matrix;
}

/// Observations of a few unknowns, one in each row, in clusters of these sizes.
struct Fit {
  Eigen::MatrixXd X;
  std::vector<Eigen::Index> cluster_sizes;

  Eigen::MatrixXd inverse() const { return (X.transpose() * X).inverse(); }
  /// What the errors move the unknowns by.
  Eigen::VectorXd error(const Eigen::VectorXd& errors) const {
    return inverse() * X.transpose() * errors;
  }
  /// The clusters of a fit of these errors.
  std::vector<ClusterStep> clusters(const Eigen::VectorXd& errors) const {
    const Eigen::MatrixXd K = Eigen::LLT<Eigen::MatrixXd>(inverse()).matrixL();
    const Eigen::VectorXd residuals = errors - X * error(errors);
    std::vector<ClusterStep> steps;
    Eigen::Index from = 0;
    for (const Eigen::Index size : cluster_sizes) {
      const Eigen::MatrixXd own = X.middleRows(from, size);
      steps.push_back(
          cluster_step(own.transpose() * residuals.segment(from, size), own.transpose() * own, K));
      from += size;
    }
    return steps;
  }
};

Fit random_fit(Rng& rng, const std::vector<Eigen::Index>& cluster_sizes, Eigen::Index unknowns) {
  const Eigen::Index rows =
      std::accumulate(cluster_sizes.begin(), cluster_sizes.end(), Eigen::Index{0});
  return {normal_matrix(rng, rows, unknowns), cluster_sizes};
}

TEST(ClusterStep, HasNoBiasWithFewClustersOfUnequalLeverage) {
  Rng rng = test::test_rng();
  const Fit fit = random_fit(rng, {2, 3, 4, 12}, 2);
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(2, 2);
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    for (const ClusterStep& cluster : fit.clusters(normal_matrix(rng, fit.X.rows(), 1))) {
      mean += cluster.step * cluster.step.transpose() / kDraws;
    }
  }
  // The truth for errors of variance 1. The trace of the sandwich is 0.43 times its own here, that
  // of the jackknife 3.6 times.
  const Eigen::MatrixXd truth = fit.inverse();
  EXPECT_LT((mean - truth).norm(), 0.03 * truth.norm());
}

TEST(ClusterStep, HasTheVariancesOfItsStepForErrorsThatAreAsWeightsSay) {
  Rng rng = test::test_rng();
  const Fit fit = random_fit(rng, {3, 5, 9}, 3);
  const std::size_t clusters = fit.cluster_sizes.size();
  std::vector<Eigen::VectorXd> squares(clusters, Eigen::VectorXd::Zero(3));
  constexpr int kDraws = 40000;
  for (int i = 0; i < kDraws; ++i) {
    const auto drawn = fit.clusters(normal_matrix(rng, fit.X.rows(), 1));
    for (std::size_t c = 0; c < clusters; ++c) squares[c] += drawn[c].step.cwiseAbs2() / kDraws;
  }
  const auto expected = fit.clusters(Eigen::VectorXd::Zero(fit.X.rows()));
  for (std::size_t c = 0; c < clusters; ++c) {
    EXPECT_LT((squares[c] - expected[c].variances).norm(), 0.05 * expected[c].variances.norm());
  }
}

TEST(CovarianceByClusters, HoldsTheTruthInNineOfTenWithFewClusters) {
  Rng rng = test::test_rng();
  constexpr int kFits = 200, kDraws = 100;
  const double normal_90 = 1.6449;
  int held = 0, held_by_sum = 0, all = 0;
  for (int f = 0; f < kFits; ++f) {
    const Fit fit = random_fit(rng, {4, 4, 6, 6, 8, 12}, 2);
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::VectorXd errors = normal_matrix(rng, fit.X.rows(), 1);
      const Eigen::VectorXd error = fit.error(errors).cwiseAbs();
      const std::vector<ClusterStep> clusters = fit.clusters(errors);
      const Eigen::VectorXd widened = covariance_by_clusters(clusters).diagonal().cwiseSqrt();
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(2);
      for (const ClusterStep& cluster : clusters) sum += cluster.step.cwiseAbs2();
      for (Eigen::Index unknown = 0; unknown < 2; ++unknown) {
        ++all;
        held += error(unknown) < normal_90 * widened(unknown) ? 1 : 0;
        held_by_sum += error(unknown) < normal_90 * std::sqrt(sum(unknown)) ? 1 : 0;
      }
    }
  }
  EXPECT_NEAR(held, 0.9 * all, 0.015 * all);
  EXPECT_LT(held_by_sum, 0.86 * all);
}

TEST(CovarianceByClusters, KeepsCorrelationsAndIsTheSumOfManyClusters) {
  Rng rng = test::test_rng();
  const Fit few = random_fit(rng, {4, 4, 6, 6}, 2);
  const Fit many = random_fit(rng, std::vector<Eigen::Index>(2000, 2), 2);
  for (const Fit& fit : {few, many}) {
    const auto clusters = fit.clusters(normal_matrix(rng, fit.X.rows(), 1));
    Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
    for (const ClusterStep& cluster : clusters) sum += cluster.step * cluster.step.transpose();
    const Eigen::Matrix2d covariance = covariance_by_clusters(clusters);
    const auto correlation = [](const Eigen::Matrix2d& C) {
      return C(0, 1) / std::sqrt(C(0, 0) * C(1, 1));
    };
    EXPECT_NEAR(correlation(covariance), correlation(sum), 1e-12);
    const double widest = clusters.size() > 1000 ? 1.003 : 3.0;
    EXPECT_LT(covariance.norm(), widest * sum.norm());
    EXPECT_GT(covariance.norm(), sum.norm());
  }
}

TEST(StudentWidening, MakesAnIntervalOf90PercentThatOfStudentsT) {
  for (const double freedom : {2.0, 2.5, 3.0, 4.0, 6.0, 9.5, 20.0, 100.0, 1e4}) {
    const double quantile = boost::math::quantile(boost::math::students_t(freedom), 0.95);
    EXPECT_NEAR(1.6449 * student_widening(freedom) / quantile, 1.0, 0.03) << freedom;
  }
  EXPECT_EQ(student_widening(1.0), student_widening(1.5));
}

TEST(ClusterStep, IsFiniteForAClusterThatAloneHoldsADirection) {
  const Eigen::MatrixXd K = Eigen::MatrixXd::Identity(2, 2);
  const Eigen::Vector2d gradient(0.1, 0.1);
  const Eigen::Vector2d step =
      cluster_step(gradient, Eigen::Vector2d(1.0, 0.0).asDiagonal(), K).step;
  EXPECT_NEAR(step.x(), 1.0, 1e-12);
  EXPECT_NEAR(step.y(), 0.1, 1e-12);
}

}  // namespace
}  // namespace croon

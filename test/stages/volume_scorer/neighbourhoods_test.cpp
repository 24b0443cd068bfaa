#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/stage/joint_neighbourhoods.hpp"
#include "framework/stage/pose_search.hpp"
#include "test/stages/volume_scorer/scorers.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

/// The covariance of all points around `place` in the target's frame, word for word.
Eigen::Matrix3d covariance_around(const Eigen::Vector3d& place, const Points& target,
                                  const Points& source, const RigidTransform& T, double radius_m) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3f& point : target) points.emplace_back(point.cast<double>());
  for (const Eigen::Vector3f& point : source) points.emplace_back(T * point.cast<double>());
  double sum = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const auto weight = [&](const Eigen::Vector3d& point) {
    const double share = std::max(0.0, 1.0 - (point - place).squaredNorm() / (radius_m * radius_m));
    return share * share;
  };
  for (const Eigen::Vector3d& point : points) {
    sum += weight(point);
    mean += weight(point) * point;
  }
  mean /= sum;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    covariance += weight(point) / sum * (point - mean) * (point - mean).transpose();
  }
  return covariance;
}

class Neighbourhoods : public testing::TestWithParam<const char*> {
 protected:
  params::Slot<VolumeScorer> scorer() const {
    return test::stage<VolumeScorer>(std::string(R"({"type": ")") + GetParam() + R"("})");
  }
};

TEST_P(Neighbourhoods, AreThoseOfBothClouds) {
  Rng rng = test::test_rng();
  for (const float extent_m : {0.3F, 1.0F}) {
    const Points target = test::random_cloud(rng, 300, extent_m);
    const Points source = test::random_cloud(rng, 200, extent_m);
    const VolumeFunction volume = scorer()->bind(test::cloud_of(target), test::cloud_of(source));
    const RigidTransform T = test::random_pose(rng, 0.2);
    const bool is_entropy = std::string(GetParam()) == "mean_map_entropy";
    double sum = 0.0;
    for (const Eigen::Vector3f& point : source) {
      const Eigen::Matrix3d covariance =
          covariance_around(T * point.cast<double>(), target, source, T, 0.3) +
          1e-4 * Eigen::Matrix3d::Identity();
      const double least =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()(0);
      sum += is_entropy ? 0.5 * std::log((2.0 * M_PI * M_E * covariance).determinant())
                        : M_PI * 0.09 * std::sqrt(12.0 * least);
    }
    const double mean = sum / static_cast<double>(source.size());
    const double expected = is_entropy ? std::exp(mean) : mean;
    EXPECT_NEAR(volume(T).m3, expected, 1e-6 * expected);
  }
}

TEST_P(Neighbourhoods, AreTheSameFromBothSidesOfAPose) {
  Rng rng = test::test_rng();
  const Points target = test::random_street(rng, 3, 5000, 0.01);
  const Points source = test::random_street(rng, 4, 3000, 0.01);
  const RigidTransform T = test::random_pose(rng, 0.2);
  const RigidTransform moved = test::random_pose(rng, 5.0);
  const double there = scorer()->bind(test::cloud_of(target), test::cloud_of(source))(T).m3;
  const double moved_there =
      scorer()
          ->bind(test::cloud_of(transformed(target, moved)), test::cloud_of(source))(moved * T)
          .m3;
  EXPECT_NEAR(there, moved_there, 1e-3 * there);
}

TEST_P(Neighbourhoods, WithoutPointsOccupyNothing) {
  const Points one = {{1.0F, 2.0F, 3.0F}};
  EXPECT_EQ(scorer()->bind(test::cloud_of(one), test::cloud_of({}))({}).m3, 0.0);
  EXPECT_EQ(scorer()->bind(test::cloud_of({}), test::cloud_of({}))({}).m3, 0.0);
  EXPECT_GT(scorer()->bind(test::cloud_of({}), test::cloud_of(one))({}).m3, 0.0);
}

TEST_P(Neighbourhoods, ASearchWithoutDerivativesFindsThePose) {
  const auto search = test::stage<PoseSearch>(R"({"type": "bobyqa"})");
  Rng rng = test::test_rng();
  const RigidTransform truth = test::random_pose(rng, 2.0);
  const Points target = test::random_street(rng, 5, 40000, 0.01);
  const Points source = transformed(test::random_street(rng, 5, 20000, 0.01), truth.inverse());
  const VolumeFunction volume = scorer()->bind(test::cloud_of(target), test::cloud_of(source));
  const PoseCost cost([&](const RigidTransform& pose) { return volume(pose).m3; });
  const RigidTransform start = test::pose_near(rng, truth, 0.3, 0.03);
  const PoseError error = pose_error(search->minimise(cost, start).pose, truth);
  EXPECT_LT(deg_from_rad(error.rotation_rad), 0.1);
  EXPECT_LT(error.translation_m, 0.015);
}

INSTANTIATE_TEST_SUITE_P(Scorers, Neighbourhoods,
                         testing::Values("mean_map_entropy", "mean_plane_variance"),
                         [](const auto& scorer) { return std::string(scorer.param); });

}  // namespace
}  // namespace croon

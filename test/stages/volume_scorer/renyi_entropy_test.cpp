#include <gtest/gtest.h>

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/volume_scorer.hpp"
#include "test/stages/volume_scorer/scorers.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/stages.hpp"

namespace croon {
namespace {

/// The definition word for word: all pairs of points of different clouds, and each with itself.
double volume_of_pairs(const Points& target, const Points& source, const RigidTransform& T,
                       double width_m) {
  const auto n = static_cast<double>(target.size() + source.size());
  double sum = n;
  for (const Eigen::Vector3f& t : target) {
    for (const Eigen::Vector3f& s : source) {
      const double distance_m = (T * s.cast<double>() - t.cast<double>()).norm();
      sum += 2 * std::exp(-distance_m * distance_m / (4 * width_m * width_m));
    }
  }
  return n * n / sum * std::pow(4 * M_PI * width_m * width_m, 1.5);
}

TEST(RenyiEntropy, IsThatOfAllPairs) {
  const auto scorer = test::stage<VolumeScorer>(R"({"type": "renyi_entropy", "width_m": 0.1})");
  Rng rng = test::test_rng();
  for (const double extent_m : {0.3, 1.0, 3.0}) {
    const Points target = test::random_cloud(rng, 400, extent_m);
    const Points source = test::random_cloud(rng, 300, extent_m);
    const VolumeFunction volume = scorer->bind(test::cloud_of(target), test::cloud_of(source));
    for (int i = 0; i < 5; ++i) {
      const RigidTransform pose = test::random_pose(rng, extent_m);
      const double expected = volume_of_pairs(target, source, pose, 0.1);
      EXPECT_NEAR(volume(pose).m3, expected, 1e-2 * expected);
    }
  }
}

TEST(RenyiEntropy, IsFiniteWithoutAnOverlapAndZeroWithoutPoints) {
  const auto scorer = test::stage<VolumeScorer>(R"({"type": "renyi_entropy", "width_m": 0.1})");
  const Points one = {{1.0F, 2.0F, 3.0F}};
  const RigidTransform far{Eigen::Matrix3d::Identity(), Eigen::Vector3d(100, 0, 0)};
  const double of_one = std::pow(4 * M_PI * 0.01, 1.5);
  EXPECT_DOUBLE_EQ(scorer->bind(test::cloud_of(one), test::cloud_of(one))(far).m3, 2 * of_one);
  EXPECT_DOUBLE_EQ(scorer->bind(test::cloud_of(one), test::cloud_of(one))({}).m3, of_one);
  EXPECT_DOUBLE_EQ(scorer->bind(test::cloud_of({}), test::cloud_of(one))({}).m3, of_one);
  EXPECT_EQ(scorer->bind(test::cloud_of({}), test::cloud_of({}))({}).m3, 0.0);
}

TEST(RenyiEntropy, IsSmoothInThePose) {
  // Of a smooth function the values at half the step differ from the mean of their neighbours by a
  // quarter as much.
  const auto scorer = test::stage<VolumeScorer>(R"({"type": "renyi_entropy"})");
  Rng rng = test::test_rng();
  const Points street = test::random_street(rng, 3, 20000, 0.005);
  const VolumeFunction volume = scorer->bind(test::cloud_of(street), test::cloud_of(street));
  const auto bend = [&](double step_m) {
    const auto at = [&](double x_m) {
      return volume({Eigen::Matrix3d::Identity(), Eigen::Vector3d(x_m, 0.0, 0.0)}).m3;
    };
    return at(step_m) - 2.0 * at(0.0) + at(-step_m);
  };
  EXPECT_NEAR(bend(0.01) / bend(0.005), 4.0, 0.5);
}

TEST(RenyiEntropy, ASearchWithoutDerivativesFindsThePose) {
  const auto scorer = test::stage<VolumeScorer>(R"({"type": "renyi_entropy"})");
  const auto search = test::stage<PoseSearch>(R"({"type": "bobyqa"})");
  Rng rng = test::test_rng();
  for (int i = 0; i < 3; ++i) {
    const RigidTransform truth = test::random_pose(rng, 2.0);
    const Points target = test::random_street(rng, 5, 40000, 0.01);
    const Points source = transformed(test::random_street(rng, 5, 20000, 0.01), truth.inverse());
    const VolumeFunction volume = scorer->bind(test::cloud_of(target), test::cloud_of(source));
    const PoseCost cost([&](const RigidTransform& pose) { return volume(pose).m3; });
    const RigidTransform start = test::pose_near(rng, truth, 0.3, 0.03);
    const PoseError error = pose_error(search->minimise(cost, start).pose, truth);
    EXPECT_LT(deg_from_rad(error.rotation_rad), 0.1);
    EXPECT_LT(error.translation_m, 0.01);
  }
}

}  // namespace
}  // namespace croon

#include <gtest/gtest.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "test/stages/volume_scorer/scorers.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

const std::vector<double> kLeafSizes = {0.02, 0.05, 0.1, 0.25, 0.5};

std::vector<RigidTransform> random_poses(Rng& rng, int count, double extent_m) {
  std::vector<RigidTransform> poses = {RigidTransform{}};
  while (static_cast<int>(poses.size()) < count) poses.push_back(test::random_pose(rng, extent_m));
  return poses;
}

RigidTransform shifted(double x, double y, double z) {
  return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(x, y, z)};
}

TEST(VolumeScorers, AreThere) { EXPECT_GE(test::all_scorers(0.05).size(), 2U); }

TEST(VolumeScorers, CountLikeTheSetOnRandomClouds) {
  Rng rng = test::test_rng();
  for (const double leaf_size_m : kLeafSizes) {
    for (const double extent_m : {0.3, 3.0, 30.0}) {
      const Points target = test::random_cloud(rng, 800, extent_m);
      const Points source = test::random_cloud(rng, 500, extent_m);
      test::expect_equal_counts(target, source, random_poses(rng, 8, extent_m), leaf_size_m);
    }
  }
}

TEST(VolumeScorers, CountLikeTheSetOnOneSideOfTheOrigin) {
  Rng rng = test::test_rng();
  const Points cloud = test::random_cloud(rng, 600, 2.0);
  for (const double side : {-1.0, 1.0}) {
    const Points target = transformed(cloud, shifted(side * 7, side * 70, -side * 700));
    const Points source = transformed(cloud, shifted(side * 8, side * 71, -side * 701));
    test::expect_equal_counts(target, source, random_poses(rng, 6, 1.0), 0.1);
  }
}

TEST(VolumeScorers, CountLikeTheSetWhereALongLeverShowsARoundedPose) {
  Rng rng = test::test_rng();
  // Half of the leaves are full, so that a point which changes its leaf changes the count.
  const Points lump = test::random_cloud(rng, 20000, 0.3);
  const Points far_lump = transformed(lump, shifted(80, 60, -40));
  for (int i = 0; i < 3; ++i) {
    const RigidTransform T = test::random_pose(rng, 1.0);
    const Eigen::Vector3d place = T * Eigen::Vector3d(80, 60, -40);
    const Points target = transformed(lump, {T.rotation, place});
    test::expect_equal_counts(target, far_lump, {T}, 0.02);
  }
}

TEST(VolumeScorers, CountLikeTheSetOnTheBordersOfLeaves) {
  Rng rng = test::test_rng();
  for (const double leaf_size_m : kLeafSizes) {
    Points cloud;
    for (int i = 0; i < 600; ++i) {
      const Eigen::Vector3d corner{static_cast<double>(rng.below(16)) - 8,
                                   static_cast<double>(rng.below(16)) - 8,
                                   static_cast<double>(rng.below(16)) - 8};
      cloud.push_back((leaf_size_m * corner).cast<float>());
    }
    const std::vector<RigidTransform> poses = {
        shifted(0, 0, 0), shifted(leaf_size_m, -leaf_size_m, 0), shifted(leaf_size_m / 2, 0, 0)};
    test::expect_equal_counts(cloud, cloud, poses, leaf_size_m);
  }
}

TEST(VolumeScorers, CountASourceFarOutsideOfTheTargetsCube) {
  Rng rng = test::test_rng();
  const Points target = test::random_cloud(rng, 300, 1.0);
  const Points source = test::random_cloud(rng, 300, 1.0);
  std::vector<RigidTransform> poses;
  for (const double far_m : {3.0, 1e3, 1e6}) {
    for (int i = 0; i < 4; ++i) poses.push_back(test::random_pose(rng, far_m));
    poses.push_back(shifted(far_m, 0, 0));
    poses.push_back(shifted(0, -far_m, far_m));
  }
  test::expect_equal_counts(target, source, poses, 0.05);
}

TEST(VolumeScorers, CountToTheEndsOfTheGrid) {
  const float end_m = static_cast<float>(LeafGrid::kMaxIndex) * 0.5F;
  Points corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({i & 1 ? end_m : -end_m, i & 2 ? end_m : -end_m, i & 4 ? end_m : -end_m});
  }
  const Points near = {{0.1F, 0.1F, 0.1F}, {-0.1F, 0.1F, 0.1F}};
  test::expect_equal_counts(corners, near, {RigidTransform{}, shifted(9, 9, -9)}, 0.5);
  test::expect_equal_counts(near, corners, {RigidTransform{}}, 0.5);
  std::reverse(corners.begin(), corners.end());
  test::expect_equal_counts(near, corners, {RigidTransform{}}, 0.5);
}

TEST(VolumeScorers, RefuseWhatIsOutsideOfTheGrid) {
  const auto near = test::cloud_of({{0.0F, 0.0F, 0.0F}});
  const auto far = test::cloud_of({{0.0F, 1e9F, 0.0F}});
  for (const auto& [name, scorer] : test::all_scorers(0.001)) {
    SCOPED_TRACE(name);
    EXPECT_THROW(scorer->bind(far, near), StageError);
    const VolumeFunction volume = scorer->bind(near, far);
    EXPECT_THROW(volume(RigidTransform{}), StageError);
    EXPECT_EQ(volume(shifted(0, -1e9, 0)).leaves, 1);
  }
}

TEST(VolumeScorers, CountLikeTheSetFarFromTheOrigin) {
  Rng rng = test::test_rng();
  // As in map coordinates: farther from the origin than the keys of leaves reach from their centre.
  const Points target = transformed(test::random_cloud(rng, 500, 10.0), shifted(4e5, -5e6, 300));
  const Points source = test::random_cloud(rng, 400, 10.0);
  std::vector<RigidTransform> poses = random_poses(rng, 3, 10.0);
  for (int i = 0; i < 4; ++i) {
    poses.push_back(shifted(4e5, -5e6, 300) * test::random_pose(rng, 3.0));
  }
  test::expect_equal_counts(target, source, poses, 0.05);
}

TEST(VolumeScorers, CountLikeTheSetWithFewPointsFarFromTheOthers) {
  Rng rng = test::test_rng();
  Points target = test::random_cloud(rng, 300, 1.0);
  Points source = test::random_cloud(rng, 300, 1.0);
  for (const float far_m : {1e5F, -3e5F, 2e6F}) {
    target.push_back({far_m, 0.01F, 0.02F});
    source.push_back({far_m, 0.01F, 0.02F});
    source.push_back({0.3F, far_m, far_m});
    source.push_back({0.3F, far_m, far_m});
  }
  std::vector<RigidTransform> poses = random_poses(rng, 4, 1.0);
  poses.push_back(shifted(0, 0, 1e5));
  test::expect_equal_counts(target, source, poses, 0.02);
  std::reverse(target.begin(), target.end());  // What the keys are centred on is then far.
  std::rotate(target.begin(), target.begin() + 149, target.end());
  test::expect_equal_counts(target, source, poses, 0.02);
}

TEST(VolumeScorers, CountLikeTheSetAfterAnExceptionAndAfterALargerCloud) {
  Rng rng = test::test_rng();
  const Points large = test::random_cloud(rng, 30000, 30.0);
  Points small = test::random_cloud(rng, 300, 1.0);
  const std::vector<RigidTransform> poses = random_poses(rng, 3, 1.0);
  test::expect_equal_counts(small, large, poses, 0.05);
  test::expect_equal_counts(large, small, poses, 0.05);
  Points beyond = small;
  beyond.push_back({0.0F, 1e9F, 0.0F});
  for (const auto& [name, scorer] : test::all_scorers(0.05)) {
    SCOPED_TRACE(name);
    const VolumeFunction refused = scorer->bind(test::cloud_of(small), test::cloud_of(beyond));
    EXPECT_THROW(refused(RigidTransform{}), StageError);
    const VolumeFunction volume = scorer->bind(test::cloud_of(small), test::cloud_of(large));
    EXPECT_EQ(volume(poses[1]).leaves, test::leaves_by_set(small, large, poses[1], 0.05));
  }
}

TEST(VolumeScorers, CountFewPointsAndNone) {
  Rng rng = test::test_rng();
  const Points one = {{-0.3F, 0.7F, 2.0F}};
  const Points same(100, one[0]);
  const Points many = test::random_cloud(rng, 100, 1.0);
  const std::vector<RigidTransform> poses = random_poses(rng, 5, 2.0);
  for (const Points& target : {Points{}, one, same, many}) {
    for (const Points& source : {Points{}, one, same, many}) {
      test::expect_equal_counts(target, source, poses, 0.1);
    }
  }
}

}  // namespace
}  // namespace croon

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "framework/base/error.hpp"
#include "framework/base/threads.hpp"
#include "test/stages/volume_scorer/scorers.hpp"
#include "test/support/random_geometry.hpp"

namespace croon {
namespace {

/// One street, sampled once and split between two sensors. Its walls are askew in the target's
/// frame, as they are in a real one's: those along the grid of leaves count by where they lie
/// between its borders.
struct SplitStreet {
  Points target;
  Points source;
  RigidTransform T_target_source;
};

SplitStreet split_street(Rng& rng, int count) {
  const RigidTransform T_target_street = test::random_pose(rng, 1.0);
  const RigidTransform T_source_street = test::random_pose(rng, 1.0);
  Points halves[2];
  int next = 0;
  for (const Eigen::Vector3f& point : test::random_street(rng, rng.bits(), count, 0.005)) {
    halves[next++ % 2].push_back(point);
  }
  return {transformed(halves[0], T_target_street), transformed(halves[1], T_source_street),
          T_target_street * T_source_street.inverse()};
}

/// A translation of `low_m` to `high_m` in any direction.
Eigen::Vector3d random_translation(Rng& rng, double low_m, double high_m) {
  const Eigen::Vector3d direction{rng.normal(), rng.normal(), rng.normal()};
  return rng.uniform(low_m, high_m) * direction.normalized();
}

TEST(OccupiedVolume, IsLeavesTimesTheVolumeOfOne) {
  EXPECT_DOUBLE_EQ(OccupiedVolume::of_leaves(3, 0.5).m3, 0.375);
  EXPECT_DOUBLE_EQ(OccupiedVolume::of_leaves(0, 0.5).m3, 0.0);
}

TEST(VolumeScorers, AlignedCloudsOccupyTheLeast) {
  Rng rng = test::test_rng();
  for (int street = 0; street < 3; ++street) {
    const SplitStreet split = split_street(rng, 30000);
    const auto target = test::cloud_of(split.target);
    const auto source = test::cloud_of(split.source);
    for (const auto& [name, scorer] : test::all_scorers(0.05)) {
      SCOPED_TRACE(name);
      const VolumeFunction volume = scorer->bind(target, source);
      const double at_truth_m3 = volume(split.T_target_source).m3;
      for (int i = 0; i < 30; ++i) {
        RigidTransform pose = split.T_target_source;
        pose.translation += random_translation(rng, 0.05, 0.2);
        EXPECT_LT(at_truth_m3, volume(pose).m3);
      }
    }
  }
}

TEST(VolumeScorers, ACloudOnItselfOccupiesWhatItOccupiesAlone) {
  Rng rng = test::test_rng();
  const Points points = test::random_street(rng, 1, 5000, 0.01);
  const auto cloud = test::cloud_of(points);
  const auto none = test::cloud_of({});
  for (const double leaf_size_m : {0.02, 0.05, 0.5}) {
    for (const auto& [name, scorer] : test::all_scorers(leaf_size_m)) {
      SCOPED_TRACE(name);
      const std::int64_t alone = scorer->bind(cloud, none)(RigidTransform{}).leaves;
      EXPECT_EQ(alone, test::leaves_by_set(points, {}, RigidTransform{}, leaf_size_m));
      EXPECT_EQ(scorer->bind(cloud, cloud)(RigidTransform{}).leaves, alone);
      EXPECT_EQ(scorer->bind(none, cloud)(RigidTransform{}).leaves, alone);
    }
  }
}

TEST(VolumeScorers, TheUnionIsNeverLessThanAPartNorMoreThanTheSum) {
  Rng rng = test::test_rng();
  const auto none = test::cloud_of({});
  for (int i = 0; i < 20; ++i) {
    const auto target = test::cloud_of(test::random_cloud(rng, 500, 1.0));
    const auto source = test::cloud_of(test::random_cloud(rng, 400, 1.0));
    const RigidTransform pose = test::random_pose(rng, 0.5);
    for (const auto& [name, scorer] : test::all_scorers(0.2)) {
      SCOPED_TRACE(name);
      const std::int64_t together = scorer->bind(target, source)(pose).leaves;
      const std::int64_t target_alone = scorer->bind(target, none)(pose).leaves;
      const std::int64_t source_alone = scorer->bind(none, source)(pose).leaves;
      EXPECT_GE(together, std::max(target_alone, source_alone));
      EXPECT_LE(together, target_alone + source_alone);
    }
  }
}

TEST(VolumeScorers, FourThreadsAtOnceGetWhatOneGets) {
  Rng rng = test::test_rng();
  const SplitStreet split = split_street(rng, 8000);
  std::vector<RigidTransform> poses;
  for (int i = 0; i < 40; ++i) {
    poses.push_back(test::pose_near(rng, split.T_target_source, 5.0, 0.5));
  }
  for (const auto& [name, scorer] : test::all_scorers(0.05)) {
    SCOPED_TRACE(name);
    std::vector<std::vector<std::int64_t>> counts(4, std::vector<std::int64_t>(poses.size()));
    // The clouds are new, so that the threads also compete for what is computed once per cloud.
    const auto target = test::cloud_of(split.target);
    const auto source = test::cloud_of(split.source);
    std::vector<std::thread> threads;
    for (std::vector<std::int64_t>& mine : counts) {
      threads.emplace_back([&, scorer = &*scorer] {
        const VolumeFunction volume = scorer->bind(target, source);
        for (std::size_t i = 0; i < poses.size(); ++i) mine[i] = volume(poses[i]).leaves;
      });
    }
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const std::int64_t expected = test::leaves_by_set(split.target, split.source, poses[i], 0.05);
      for (const std::vector<std::int64_t>& mine : counts) EXPECT_EQ(mine[i], expected);
    }
  }
}

TEST(VolumeScorers, ManyPosesOnManyThreadsGetWhatOneGetsAlone) {
  Rng rng = test::test_rng();
  const SplitStreet split = split_street(rng, 6000);
  std::vector<RigidTransform> poses;
  for (int i = 0; i < 33; ++i) {
    poses.push_back(test::pose_near(rng, split.T_target_source, 5.0, 0.5));
  }
  for (const auto& [name, scorer] : test::all_scorers(0.05)) {
    SCOPED_TRACE(name);
    const VolumeFunction volume =
        scorer->bind(test::cloud_of(split.target), test::cloud_of(split.source));
    EXPECT_TRUE(volume.at({}).empty());
    for (const int jobs : {1, 4}) {
      on_threads(jobs, [&] {
        const std::vector<OccupiedVolume> volumes = volume.at(poses);
        ASSERT_EQ(volumes.size(), poses.size());
        for (std::size_t i = 0; i < poses.size(); ++i) {
          EXPECT_EQ(volumes[i].leaves, volume(poses[i]).leaves);
          EXPECT_EQ(volumes[i].m3, volume(poses[i]).m3);
        }
      });
    }
  }
}

TEST(VolumeScorers, AnExceptionAtOneOfManyPosesReachesTheCallerFromItsThread) {
  Rng rng = test::test_rng();
  const Points points = test::random_cloud(rng, 300, 1.0);
  const RigidTransform outside{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 1e12, 0)};
  for (const auto& [name, scorer] : test::all_scorers(0.05)) {
    SCOPED_TRACE(name);
    const VolumeFunction volume = scorer->bind(test::cloud_of(points), test::cloud_of(points));
    EXPECT_THROW(volume.at({{}, {}, outside, {}}), StageError);
    EXPECT_EQ(volume.at({{}, {}}).at(1).leaves, test::leaves_by_set(points, points, {}, 0.05));
  }
}

TEST(VolumeScorers, BindTheSecondTimeWithoutWorkOnTheTarget) {
  Rng rng = test::test_rng();
  const auto target = test::cloud_of(test::random_cloud(rng, 300, 1.0));
  for (const auto& [name, scorer] : test::all_scorers(0.1)) {
    SCOPED_TRACE(name);
    const std::size_t before = target->timings().size();
    scorer->bind(target, test::cloud_of({}))(RigidTransform{});
    const std::size_t after = target->timings().size();
    EXPECT_GT(after, before);
    scorer->bind(target, test::cloud_of({}))(RigidTransform{});
    EXPECT_EQ(target->timings().size(), after);
  }
}

TEST(VolumeScorers, AFunctionOutlivesWhatItWasBoundTo) {
  Rng rng = test::test_rng();
  const Points points = test::random_cloud(rng, 300, 1.0);
  const RigidTransform pose = test::random_pose(rng, 0.5);
  for (std::size_t i = 0; i < test::all_scorers(0.1).size(); ++i) {
    const VolumeFunction volume =
        test::all_scorers(0.1)[i].second->bind(test::cloud_of(points), test::cloud_of(points));
    EXPECT_EQ(volume(pose).leaves, test::leaves_by_set(points, points, pose, 0.1));
  }
}

}  // namespace
}  // namespace croon

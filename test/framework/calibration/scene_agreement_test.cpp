#include "framework/calibration/scene_agreement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/calibration/sensor_result.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Poses around `T` with normal errors of 0.05 degrees and 1 cm.
std::vector<ScenePose> scene_poses(Rng& rng, const RigidTransform& T, std::size_t count) {
  constexpr double kStd_rad = rad_from_deg(0.05), kStd_m = 0.01;
  Vector6d stds;
  stds << kStd_rad, kStd_rad, kStd_rad, kStd_m, kStd_m, kStd_m;
  std::vector<ScenePose> poses;
  for (std::size_t i = 0; i < count; ++i) {
    Vector6d error;
    for (int k = 0; k < 6; ++k) error(k) = stds(k) * rng.normal();
    poses.push_back({moved(T, error), Matrix6d(stds.cwiseAbs2().asDiagonal())});
  }
  return poses;
}

/// A bump by a degree about a random axis and 0.16 m along another.
RigidTransform bumped(Rng& rng, const RigidTransform& T) {
  Vector6d bump;
  bump << rad_from_deg(1.0) * random_point(rng, 1.0).normalized(),
      0.16 * random_point(rng, 1.0).normalized();
  return moved(T, bump);
}

TEST(SceneAgreement, FindsTheScenesBetweenWhichASensorMoved) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Rng rng = test_rng(seed);
    const RigidTransform T = random_pose(rng, 3.0);
    std::vector<ScenePose> poses = scene_poses(rng, T, 4);
    EXPECT_FALSE(split_of_scenes(poses)) << seed;
    for (const ScenePose& pose : scene_poses(rng, bumped(rng, T), 3)) poses.push_back(pose);
    const auto split = split_of_scenes(poses);
    ASSERT_TRUE(split) << seed;
    EXPECT_THAT(split->larger, ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(split->smaller, ElementsAre(4, 5, 6));
    EXPECT_NEAR(split->apart.rotation_rad, rad_from_deg(1.0), rad_from_deg(0.25));
    EXPECT_NEAR(split->apart.translation_m, 0.16, 0.05);
  }
}

TEST(SceneAgreement, DoesNotBlameUncertainPoses) {
  Rng rng = test_rng();
  std::vector<ScenePose> poses = scene_poses(rng, RigidTransform(), 4);
  Vector6d along_x = Vector6d::Zero();
  along_x(3) = 0.4;
  poses[3].T_reference_sensor = moved(poses[3].T_reference_sensor, along_x);
  EXPECT_TRUE(split_of_scenes(poses));
  poses[3].covariance(3, 3) = 0.04;
  EXPECT_FALSE(split_of_scenes(poses));
}

/// The result for a sensor whose accepted poses are `poses`, in the scenes "0", "1", ...
CalibratedSensor result_from(const std::vector<ScenePose>& poses) {
  std::vector<MemberResult> members;
  for (const ScenePose& pose : poses) {
    MemberResult member;
    member.T_in_scene = pose.T_reference_sensor;
    member.covariance_in_scene = PoseCovariance{pose.covariance, {}};
    // As after a step that sets one pose in all scenes.
    member.estimate.T_target_source = poses.front().T_reference_sensor;
    member.estimate.covariance = member.covariance_in_scene;
    member.has_pose = true;
    members.push_back(member);
  }
  std::vector<SceneResult> scenes;
  for (std::size_t i = 0; i < members.size(); ++i) {
    scenes.push_back({std::to_string(i), &members[i], ""});
  }
  return sensor_result("left", scenes);
}

TEST(SceneAgreement, RejectsASensorThatMovedAndNamesBothGroups) {
  Rng rng = test_rng();
  std::vector<ScenePose> poses = scene_poses(rng, RigidTransform(), 2);
  EXPECT_TRUE(result_from(poses).is_accepted);
  for (const ScenePose& pose : scene_poses(rng, bumped(rng, {}), 2)) poses.push_back(pose);
  const CalibratedSensor sensor = result_from(poses);
  EXPECT_FALSE(sensor.is_accepted);
  ASSERT_THAT(sensor.reasons, SizeIs(1));
  EXPECT_THAT(sensor.reasons.front(), HasSubstr("between the scenes 0, 1 | 2, 3 by"));
  EXPECT_THAT(sensor.advice, SizeIs(1));
}

TEST(SceneAgreement, DoesNotUseASceneThatDiffersFromManyOthers) {
  Rng rng = test_rng();
  std::vector<ScenePose> poses = scene_poses(rng, RigidTransform(), 6);
  poses[0].T_reference_sensor = bumped(rng, {});
  const CalibratedSensor sensor = result_from(poses);
  EXPECT_TRUE(sensor.is_accepted);
  EXPECT_TRUE(sensor.scenes[0].is_outlier);
  EXPECT_THAT(sensor.scenes[0].reason, HasSubstr("differs from that of the other scenes"));
  ASSERT_TRUE(sensor.T_reference_sensor);
  EXPECT_LT(sensor.T_reference_sensor->translation.norm(), 0.03);
}

}  // namespace
}  // namespace croon::test

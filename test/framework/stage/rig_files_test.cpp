#include "framework/stage/rig_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;

TEST(RigPoses, AreInDegreesAndMetres) {
  const test::TempFolder folder;
  const RigPoses poses = read_rig_poses(folder.write(
      "truth.json",
      R"({"left": {"rotation_rpy_deg": [10, 20, -30], "translation_m": [1, 2.5, -3]}})"));
  ASSERT_EQ(poses.size(), 1u);
  const Eigen::Vector3d rpy_rad(rad_from_deg(10), rad_from_deg(20), rad_from_deg(-30));
  EXPECT_LT((poses.at("left").rotation - rotation_from_rpy(rpy_rad)).norm(), 1e-15);
  EXPECT_EQ(poses.at("left").translation, Eigen::Vector3d(1, 2.5, -3));
}

TEST(RigPoses, ReadStrictly) {
  const test::TempFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"[]", "/: expected an object"},
      {R"({"a": 1})", "/a: expected an object"},
      {R"({"a": {"rotation_rpy_deg": [0, 0, 0]}})", "/a: the key \"translation_m\" is missing"},
      {R"({"a": {"rotation_rpy_deg": [0, 0], "translation_m": [0, 0, 0]}})",
       "/a/rotation_rpy_deg: expected a list of three numbers, found [0,0]"},
      {R"({"a": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, "1", 0]}})",
       "/a/translation_m/1: expected a number"},
      {R"({"a": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, -2e6, 0]}})",
       "/a/translation_m/1: expected a number from -1000000 to 1000000 m, found -2000000.0"},
      {R"({"a": {"rotation_rpy_deg": [0, 0, 0], "translation": [0, 0, 0], "translation_m": [0, 0, 0]}})",
       "did you mean \"translation_m\""},
      {R"({"a": {}, "a": {}})", "duplicate key"}};
  for (const auto& [json, message] : cases) {
    const auto path = folder.write("truth.json", json);
    EXPECT_THAT(test::input_error([&] { read_rig_poses(path); }), HasSubstr(message)) << json;
  }
}

/// The pose that a file gives back.
RigidTransform written_and_read(const RigidTransform& T) {
  const test::TempFolder folder;
  return read_rig_poses(folder.write("truth.json", rig_poses_json({{"a", T}}))).at("a");
}

TEST(RigPoses, AreWrittenAndReadToTheLastBit) {
  std::vector<RigidTransform> poses;
  for (const double roll_deg : {0.0, 180.0, -180.0}) {
    for (const double pitch_deg : {0.0, 48.0, -89.0}) {
      for (const double yaw_deg : {0.0, 90.0, -90.0, 180.0, -180.0}) {
        const Eigen::Vector3d rpy_deg(roll_deg, pitch_deg, yaw_deg);
        poses.push_back({rotation_from_rpy(rpy_deg * rad_from_deg(1.0)), {2.9, 0.15, -1.195}});
      }
    }
  }
  Rng rng = test::test_rng();
  for (int i = 0; i < 200; ++i) poses.push_back(test::random_pose(rng, 5.0));
  for (const RigidTransform& pose : poses) {
    const RigidTransform as_written = pose_as_written(pose);
    const RigidTransform read = written_and_read(pose);
    EXPECT_EQ(read.rotation, as_written.rotation);
    EXPECT_EQ(read.translation, as_written.translation);
    EXPECT_EQ(pose_as_written(as_written).rotation, as_written.rotation);
    EXPECT_LT((as_written.rotation - pose.rotation).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace croon

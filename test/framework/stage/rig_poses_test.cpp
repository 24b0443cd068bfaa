#include "framework/stage/rig_poses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
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
      {R"({"a": {"rotation_rpy_deg": [0, 0, 0], "translation": [0, 0, 0], "translation_m": [0, 0, 0]}})",
       "did you mean \"translation_m\""},
      {R"({"a": {}, "a": {}})", "twice"}};
  for (const auto& [json, message] : cases) {
    const auto path = folder.write("truth.json", json);
    EXPECT_THAT(test::input_error([&] { read_rig_poses(path); }), HasSubstr(message)) << json;
  }
}

}  // namespace
}  // namespace croon

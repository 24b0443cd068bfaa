#include "framework/io/opencalib_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

TEST(CloudList, NamesSensors) {
  const test::TempFolder folder;
  const auto read = [&](const std::string& text) {
    return read_cloud_list(folder.write("list.txt", text));
  };
  const std::string text =
      "device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: a\\b\\x.pcd\nsensor: front-left\n"
      "path: c/left-2.pcd\nSensor: rear left\ndevice_id: 2\n";
  const std::vector<ListedCloud> clouds = read(text);
  ASSERT_EQ(clouds.size(), 3U);
  EXPECT_EQ(clouds[0].sensor, "top");
  EXPECT_EQ(clouds[1].sensor, "front-left");
  EXPECT_EQ(clouds[2].sensor, "rear left");
  // What is written is read.
  EXPECT_EQ(cloud_list_text(clouds),
            "device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: a\\b\\x.pcd\nsensor: front-left\n"
            "device_id: 2\npath: c/left-2.pcd\nsensor: rear left\n");
  for (const auto& [wrong, message] :
       {std::pair<const char*, const char*>{"sensor: a\ndevice_id: 0\npath: b\n",
                                            "line 1: the line precedes its device_id"},
        {"device_id: 0\npath: b\nsensor: a\nsensor: c\n",
         "line 4: the device has a duplicate line"},
        {"device_id: 0\npath: b\nsensor:\n", "line 3: expected a name, found none"}}) {
    EXPECT_NE(test::input_error([&, text = wrong] { read(text); }).find(message), std::string::npos)
        << wrong;
  }
}

using ::testing::HasSubstr;

TEST(OpencalibFiles, ReadsListsAsTheyCirculate) {
  const test::TempFolder folder;
  const char* const lists[] = {
      "device_id: 0\npath: a/top.pcd\ndevice_id: 1\npath: b c/left.pcd\n",
      "device_id: 1\r\npath: b c/left.pcd\r\n\r\ndevice_id: 0\r\npath: a/top.pcd\r\n\r\n \r\n",
      "\xEF\xBB\xBFpath: a/top.pcd\ndevice_id: 0\npath: b c/left.pcd\ndevice_id: 1",
      "\n  device_id :0\n\tpath:   a/top.pcd  \n\nDevice_ID:  1 \npath:b c/left.pcd"};
  for (const char* list : lists) {
    const std::vector<ListedCloud> clouds = read_cloud_list(folder.write("list.txt", list));
    ASSERT_EQ(clouds.size(), 2u) << list;
    EXPECT_EQ(clouds[0].device_id, 0);
    EXPECT_EQ(clouds[0].path, "a/top.pcd");
    EXPECT_EQ(clouds[1].device_id, 1);
    EXPECT_EQ(clouds[1].path, "b c/left.pcd");
  }
}

TEST(OpencalibFiles, SaysEveryLineThatIsWrong) {
  const test::TempFolder folder;
  const std::pair<const char*, const char*> cases[] = {
      {"", "expected at least one device"},
      {"top.pcd\n", "line 1: expected \"device_id: NUMBER\" or \"path: ...\", found \"top.pcd\""},
      {"device_id: 0\ndevice_id: 1\npath: b\n", "line 1: the device has no line \"path\""},
      {"device_id: 0\npath: a\ndevice_id: 1\n", "line 3: the device has no line \"path\""},
      {"device_id: 0\npath: a\npath: b\n",
       "line 3: expected a device_id for this line, found none"},
      {"device_id: 0\npath: a\ndevice_id: 0\npath: b\n", "line 4: duplicate device 0"},
      {"device_id: -1\npath: a\n", "line 1: expected a device number, found \"-1\""},
      {"device_id: 9999999999\npath: a\n", "expected a device number"},
      {"device_id: 0\npath:\n", "line 2: expected the path of a file"},
      {"a\ndevice_id: x\npath: a\n", "line 2: expected a device number, found \"x\""},
  };
  for (const auto& [text, message] : cases) {
    const auto path = folder.write("list.txt", text);
    const std::string error = test::input_error([&] { read_cloud_list(path); });
    EXPECT_THAT(error, HasSubstr(message)) << text;
    EXPECT_THAT(error, HasSubstr(path.string())) << text;
  }
}

TEST(OpencalibFiles, ReadsPosesInDegrees) {
  const test::TempFolder folder;
  const std::vector<ListedPose> poses = read_pose_list(folder.write(
      "poses.txt", "device_id: 1\r\n(Roll, Pitch, Yaw, tx, ty, tz): 10 -20 30 1 2 -3.5e0\r\n\r\n"));
  ASSERT_EQ(poses.size(), 1u);
  const Eigen::Vector3d rpy_rad(rad_from_deg(10), rad_from_deg(-20), rad_from_deg(30));
  EXPECT_LT((poses[0].T_reference_sensor.rotation - rotation_from_rpy(rpy_rad)).norm(), 1e-15);
  EXPECT_EQ(poses[0].T_reference_sensor.translation, Eigen::Vector3d(1, 2, -3.5));
  for (const char* values : {"1 2 3 4 5", "1 2 3 4 5 6 7", "1 2 3 4 5 x", "1 2 3 4 5 nan", ""}) {
    const auto path =
        folder.write("bad.txt", std::string("device_id: 1\n(Roll,Pitch,Yaw,tx,ty,tz): ") + values);
    EXPECT_THAT(test::input_error([&] { read_pose_list(path); }),
                HasSubstr("line 2: expected six numbers"));
  }
  const auto far =
      folder.write("far.txt", "device_id: 1\n(Roll,Pitch,Yaw,tx,ty,tz): 1 2 3 4 5 -1.1e6");
  EXPECT_THAT(test::input_error([&] { read_pose_list(far); }),
              HasSubstr("line 2: expected a position of at most 1000000 m, found \"1 2 3"));
}

TEST(OpenCalibFiles, ListsAreWrittenAndRead) {
  const test::TempFolder folder;
  const auto clouds = read_cloud_list(folder.write(
      "clouds.txt", cloud_list_text({{0, "0001/top.pcd", ""}, {1, "0001/left.pcd", ""}})));
  ASSERT_EQ(clouds.size(), 2u);
  EXPECT_EQ(clouds[1].device_id, 1);
  EXPECT_EQ(clouds[1].path, "0001/left.pcd");
  const Eigen::Vector3d rpy_rad(0.1, -0.7, 2.5);
  const RigidTransform pose = {rotation_from_rpy(rpy_rad), {1.0 / 3.0, -2e-7, 30.0}};
  const auto poses = read_pose_list(folder.write("poses.txt", pose_list_text({{4, pose, ""}})));
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].device_id, 4);
  EXPECT_LT((poses[0].T_reference_sensor.rotation - pose.rotation).norm(), 1e-14);
  EXPECT_EQ(poses[0].T_reference_sensor.translation, pose.translation);
}

}  // namespace
}  // namespace croon

#include "framework/calibration/extrinsics.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "framework/base/angles.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/geometry/dof.hpp"
#include "framework/io/opencalib_files.hpp"
#include "framework/stage/rig_files.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/script.hpp"
#include "test/support/temp_folder.hpp"
#include "test/support/tree.hpp"

namespace croon::test {
namespace {

/// Names without and with characters that formats have to escape.
const std::vector<std::string>& sensor_names() {
  static const std::vector<std::string> names = {"left",  "front right", "a\"b\\c'd", "größe",
                                                 "x: #1", "5",           "yes",       "<&>",
                                                 "${x}",  "a_to_b",      "no,comma"};
  return names;
}

/// A rig with random poses; some are close to a pitch of 90 degrees, one is rejected.
Extrinsics random_extrinsics(Rng& rng) {
  Extrinsics extrinsics = {"top", {}};
  for (const std::string& name : sensor_names()) {
    RigidTransform T = random_pose(rng, 20.0);
    if (name == "5") {
      T.rotation = rotation_from_rpy({rng.uniform(-3.0, 3.0), kPi / 2 - rng.uniform() * 1e-7, 1.0});
    }
    if (name == "yes") T = {};
    extrinsics.poses.push_back({name, T, name != "left"});
  }
  return extrinsics;
}

/// Reads what a format wrote: one file, or one per sensor.
std::vector<Extrinsics> read_back(const std::vector<ExtrinsicsFile>& files,
                                  const TempFolder& folder) {
  for (const ExtrinsicsFile& file : files) folder.write(file.name, file.text);
  std::vector<Extrinsics> all;
  for (const ExtrinsicsFile& file : files) {
    // A second table of nuScenes, which is read with the first.
    if (file.name != "sensor.json") all.push_back(read_extrinsics(folder.path() / file.name));
  }
  return all;
}

double largest_difference(const RigidTransform& a, const RigidTransform& b) {
  return std::max((a.rotation - b.rotation).cwiseAbs().maxCoeff(),
                  (a.translation - b.translation).cwiseAbs().maxCoeff());
}

TEST(Extrinsics, AreReadBackFromEveryFormat) {
  Rng rng = test_rng();
  for (const std::string& format : extrinsics_format_names()) {
    for (int round = 0; round < 5; ++round) {
      const TempFolder folder;
      const Extrinsics written = random_extrinsics(rng);
      std::vector<ExtrinsicPose> poses;
      for (const Extrinsics& read : read_back(write_extrinsics(written, format, true), folder)) {
        // It has no parent.
        EXPECT_EQ(read.parent, format == "csv" ? "" : "top") << format;
        poses.insert(poses.end(), read.poses.begin(), read.poses.end());
      }
      ASSERT_EQ(poses.size(), written.poses.size()) << format;
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const ExtrinsicPose& pose = written.poses[i];
        EXPECT_LT(largest_difference(poses[i].T_parent_sensor, pose.T_parent_sensor), 1e-9)
            << format << ", " << pose.sensor;
        EXPECT_TRUE(format == "kitti" || poses[i].sensor == pose.sensor) << format;
      }
      const std::set<std::string> with_verdict = {"ros2-yaml", "nuscenes", "kalibr",
                                                  "opencalib", "matrix",   "csv"};
      EXPECT_EQ(poses.front().is_accepted, with_verdict.count(format) == 0) << format;
    }
  }
}

TEST(Extrinsics, LeaveRejectedPosesOutUnlessTheyAreAskedFor) {
  Rng rng = test_rng();
  Extrinsics extrinsics = random_extrinsics(rng);
  extrinsics.poses.push_back({"lost", {}, false, {}, false});
  for (const std::string& format : extrinsics_format_names()) {
    const auto count = [&](bool with_rejected) {
      const TempFolder folder;
      std::size_t poses = 0;
      for (const Extrinsics& read :
           read_back(write_extrinsics(extrinsics, format, with_rejected), folder)) {
        poses += read.poses.size();
      }
      return poses;
    };
    const std::size_t all = sensor_names().size();
    EXPECT_EQ(count(true), all) << format;
    EXPECT_EQ(count(false), format == "csv" ? all : all - 1) << format;
    std::string text;
    for (const ExtrinsicsFile& file : write_extrinsics(extrinsics, format, true)) text += file.text;
    const bool is_marked =
        text.find("rejected") != std::string::npos || text.find("REJECTED") != std::string::npos;
    EXPECT_TRUE(is_marked) << format;
    EXPECT_EQ(text.find("lost") != std::string::npos, format == "csv") << format;
  }
}

TEST(Extrinsics, KeepDifferentNamesDifferent) {
  Rng rng = test_rng();
  Extrinsics extrinsics = {"/top/points", {}};
  for (const char* name :
       {"/left", "left", "//left", "left_2", "Left", "top/points", "a b", "a_b"}) {
    extrinsics.poses.push_back({name, random_pose(rng, 1.0)});
  }
  for (const std::string& format : extrinsics_format_names()) {
    const TempFolder folder;
    const std::vector<ExtrinsicsFile> files = write_extrinsics(extrinsics, format, false);
    std::set<std::string> file_names;
    for (const ExtrinsicsFile& file : files) {
      file_names.insert(file.name);
      EXPECT_EQ(file.name.find_first_of("/ "), std::string::npos) << file.name;
    }
    EXPECT_EQ(file_names.size(), files.size()) << format;
    std::map<std::string, RigidTransform> by_name;
    std::vector<ExtrinsicPose> poses;
    for (const Extrinsics& read : read_back(files, folder)) {
      for (const ExtrinsicPose& pose : read.poses) {
        by_name[pose.sensor] = pose.T_parent_sensor;
        EXPECT_NE(pose.sensor, read.parent) << format;
      }
    }
    EXPECT_EQ(by_name.size(), extrinsics.poses.size()) << format;
    // A name that needs no change keeps it.
    ASSERT_EQ(by_name.count("left"), 1U) << format;
    EXPECT_LT(largest_difference(by_name.at("left"), extrinsics.poses[1].T_parent_sensor), 1e-9)
        << format;
  }
}

TEST(Extrinsics, AreReadByForeignReaders) {
  Rng rng = test_rng(3);
  const TempFolder folder;
  const Extrinsics extrinsics = random_extrinsics(rng);
  for (const std::string& format : extrinsics_format_names()) {
    for (const ExtrinsicsFile& file : write_extrinsics(extrinsics, format, true)) {
      folder.write(format + "/" + file.name, file.text);
    }
  }
  const Finished ended = run_script(
      "PATH=/usr/bin:$PATH python3 -B '" +
          (source_root() / "test/framework/calibration" / "foreign_readers.py").string() +
          "' . 2>&1",
      folder.path());
  if (starts_with(ended.output, "missing: ")) GTEST_SKIP() << ended.output;
  EXPECT_EQ(ended.status, 0) << ended.output;
}

TEST(Extrinsics, OfOtherProgramsAreRead) {
  struct Example {
    const char* text;
    const char* parent;
    const char* sensor;
    Vector6d rpy_deg_xyz;
  };
  const auto values = [](double roll, double pitch, double yaw, double x, double y, double z) {
    Vector6d vector;
    vector << roll, pitch, yaw, x, y, z;
    return vector;
  };
  const double quarter = rad_from_deg(90.0);
  const std::vector<Example> examples = {
      // Shell, by options and in the older order: yaw, pitch, roll.
      {"#!/bin/sh\nros2 run tf2_ros static_transform_publisher --x 1 --yaw 1.5707963267948966 \\\n"
       "  --frame-id base --child-frame-id lidar\n",
       "base", "lidar", values(0, 0, 90, 1, 0, 0)},
      {"ros2 run tf2_ros static_transform_publisher 1 2 3 1.5707963267948966 0 0 base lidar\n",
       "base", "lidar", values(0, 0, 90, 1, 2, 3)},
      {"<launch><node pkg=\"tf2_ros\" exec=\"static_transform_publisher\" args=\"--z 3 --roll "
       "1.5707963267948966 --frame-id base --child-frame-id lidar\"/></launch>",
       "base", "lidar", values(90, 0, 0, 0, 0, 3)},
      // Chains of frames; wheels are not fixed.
      {"<robot name='r'><joint name='a' type='fixed'><parent link='base'/><child link='kit'/>"
       "<origin xyz='0 0 2'/></joint><joint name='w' type='continuous'><parent link='base'/><child "
       "link='wheel'/></joint><joint name='b' type='fixed'><parent link='kit'/><child "
       "link='lidar'/>"
       "<origin xyz='1 0 0' rpy='0 0 1.5707963267948966'/></joint></robot>",
       "base", "lidar", values(0, 0, 90, 1, 0, 2)},
      {"base:\n  kit:\n    x: 1\n    y: 0\n    z: 2\n    roll: 0\n    pitch: 0\n    yaw: 0\nkit:\n"
       "  lidar: {x: 0, y: 1e-05, z: 0, roll: 0, pitch: 0, yaw: 1.5707963267948966}\n",
       "base", "lidar", values(0, 0, 90, 1, 1e-5, 2)},
      // Kalibr: T_cam_imu maps the inertial sensor to the camera.
      {"cam0:\n  T_cam_imu:\n  - [0.0, 1.0, 0.0, -2.0]\n  - [-1.0, 0.0, 0.0, 1.0]\n"
       "  - [0.0, 0.0, 1.0, 0.0]\n  - [0.0, 0.0, 0.0, 1.0]\n  camera_model: pinhole\n",
       "imu", "cam0", values(0, 0, 90, 1, 2, 0)},
      {"P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr_velo_to_cam: 0 -1 0 1 1 0 0 2 0 0 1 3\n", "cam", "velo",
       values(0, 0, 90, 1, 2, 3)},
      {"[{\"token\": \"1\", \"sensor_token\": \"2\", \"translation\": [1, 2, 3], \"rotation\": "
       "[0.7071067811865476, 0, 0, 0.7071067811865476], \"camera_intrinsic\": []}]",
       "ego", "2", values(0, 0, 90, 1, 2, 3)},
      {"{\"extrinsics\": [{\"variant\": \"v\", \"sensor\": \"left\", \"reference_sensor\": \"top\","
       " \"T_reference_sensor\": {\"translation_m\": [1, 2, 3], \"quaternion_xyzw\": [0, 0, "
       "0.7071067811865476, 0.7071067811865476]}}, {\"variant\": \"v\", \"sensor\": \"right\", "
       "\"reference_sensor\": \"top\", \"T_reference_sensor\": null}]}",
       "top", "left", values(0, 0, 90, 1, 2, 3)},
      {"{\"left\": {\"rotation_rpy_deg\": [0, 0, 90], \"translation_m\": [1, 2, 3]}}", "", "left",
       values(0, 0, 90, 1, 2, 3)},
      {"0 -1 0 1\n1 0 0 2\n0 0 1 3\n", "", "file", values(0, 0, 90, 1, 2, 3)},
  };
  for (const Example& example : examples) {
    const TempFolder folder;
    const Extrinsics read = read_extrinsics(folder.write("file", example.text));
    EXPECT_EQ(read.parent, example.parent) << example.text;
    ASSERT_FALSE(read.poses.empty()) << example.text;
    EXPECT_EQ(read.poses.back().sensor, example.sensor) << example.text;
    const RigidTransform expected = {
        rotation_from_rpy(example.rpy_deg_xyz.head<3>() * (quarter / 90.0)),
        example.rpy_deg_xyz.tail<3>()};
    EXPECT_LT(largest_difference(read.poses.back().T_parent_sensor, expected), 1e-12)
        << example.text;
  }
}

TEST(Extrinsics, OfTheAuthorsHaveTheNamesOfTheListOfClouds) {
  const TempFolder folder;
  folder.write("lidar_cloud_path.txt",
               "device_id: 0\npath: top.pcd\ndevice_id: 1\npath: left.pcd\n");
  const Extrinsics read = read_extrinsics(folder.write(
      "initial_extrinsic.txt",
      pose_list_text({{0, {}, ""}, {1, {Eigen::Matrix3d::Identity(), {1, 2, 3}}, ""}})));
  EXPECT_EQ(read.parent, "top");
  ASSERT_EQ(read.poses.size(), 1U);
  EXPECT_EQ(read.poses[0].sensor, "left");
  EXPECT_EQ(read.poses[0].T_parent_sensor.translation, Eigen::Vector3d(1, 2, 3));
}

TEST(Extrinsics, SayWhatIsWrongWithAFile) {
  struct Fault {
    const char* text;
    const char* where;
    const char* message;
  };
  const std::vector<Fault> faults = {
      {"", "", "is empty"},
      {"hello\n", "", "begins with \"hello\""},
      {"top:\n  left: {x: 0, y: 0, z: 0, rol: 0, pitch: 0, yaw: 0}\n", "line 2",
       "expected the key \"roll\", found none; did you mean \"rol\"?"},
      {"top:\n  left: {x: 0, y: 0, z: 0, roll: 0, pitch: 0, yaw: 90}\n", "line 2",
       "is it in degrees?"},
      {"top:\n  left: {x: a, y: 0, z: 0, roll: 0, pitch: 0, yaw: 0}\n", "line 2",
       "expected a number, found \"a\""},
      {"top:\n  left: {x: .nan, y: 0, z: 0, roll: 0, pitch: 0, yaw: 0}\n", "line 2",
       "expected a number"},
      {"top: [\nroll: 1\n", "", "expected YAML"},
      {"1 0 0 0\n0 2 0 0\n0 0 1 0\n", "", "expected a rotation"},
      {"1 0 0 0\n0 1 0 0\n0 0 -1 0\n", "", "reflection"},
      {"1 0 0 0\n0 1 0 0\n0 0 1 0\n5 5 5 1\n", "", "transposed"},
      {"1 0 0\n0 1 0\n0 0 1\n", "line 1", "expected 4 numbers, found 3"},
      {"1 0 0 0\n0 1 0 0\n0 0 1 1e9\n", "", "expected a position of at most"},
      {"sensor,verdict,tx,ty,tz,qx,qy,qz,qw\n", "line 1",
       "expected the header sensor,verdict,tx_m"},
      {"sensor,verdict,tx_m,ty_m,tz_m,qx,qy,qz,qw\nleft,accepted,0,0,0,0,0,0,2\n", "line 2",
       "unit length, found one of length 2"},
      {"sensor,verdict,tx_m,ty_m,tz_m,qx,qy,qz,qw\nleft,accept,0,0,0,0,0,0,1\n", "line 2",
       "did you mean \"accepted\"?"},
      {"sensor,verdict,tx_m,ty_m,tz_m,qx,qy,qz,qw\nleft,accepted,,,,,,,\n", "line 2",
       "expected 1 number, found 0"},
      {"sensor,verdict,tx_m,ty_m,tz_m,qx,qy,qz,qw\nleft,accepted,0,0,0,0,0,0,1\n"
       "left,accepted,0,0,0,0,0,0,1\n",
       "line 3", "\"left\" has a duplicate pose; the first one: line 2"},
      {"Tr_a_to_b: 1 0 0 0 0 1 0 0 0 0 1 0\nTr_c_to_d: 1 0 0 0 0 1 0 0 0 0 1 0\n", "line 2",
       "no pose that links the two"},
      {"Tr_a_to_b: 1 0 0 0 0 1 0 0 0 0 1 0\nTr_b_to_a: 1 0 0 0 0 1 0 0 0 0 1 0\n", "line 1",
       "the frames form a loop"},
      {"Tr_a_to_b: 1 0 0 0 0 1 0 0 0 0 1\n", "line 1", "expected 12 numbers, found 11"},
      {"<robot><joint type='fixed'><parent link='a'/><child link='b'/><origin xyz='${x} 0 0'/>"
       "</joint></robot>",
       "line 1", "xacro"},
      {"<robot><joint type='fixed'><parent link='a'/></joint></robot>", "line 1",
       "expected <child link"},
      {"<robot><joint></robot>", "line 1", "expected XML"},
      {"static_transform_publisher --x 1 --frame a --child-frame-id b", "line 1",
       "expected --frame-id, found none; did you mean \"--frame\"?"},
      {"frame_id: a\nchild_frame_id: b\ntransform:\n  translation: {x: 0, y: 0, z: 0}\n", "line 4",
       "expected the key \"rotation\""},
      {"[{\"sensor_token\": \"a\", \"translation\": [0, 0], \"rotation\": [1, 0, 0, 0]}]",
       "/0/translation", "expected 3 numbers"},
      {"{\"reference\": \"top\", \"sensors\": []}", "",
       "expected the pose of a sensor, found none"},
      {"{\"left\": {\"rotation\": [0, 0, 90], \"translation_m\": [1, 2, 3]}}", "/left",
       "rotation_rpy_deg"},
      {"device_id: 1\n(Roll,Pitch,Yaw,tx,ty,tz): 1 2 3 4 5\n", "line 2", "six numbers"},
  };
  for (const Fault& fault : faults) {
    const TempFolder folder;
    const std::string message =
        input_error([&] { read_extrinsics(folder.write("rig.txt", fault.text)); });
    EXPECT_NE(message.find("rig.txt"), std::string::npos) << fault.text << ": " << message;
    EXPECT_NE(message.find(fault.where), std::string::npos) << fault.text << ": " << message;
    EXPECT_NE(message.find(fault.message), std::string::npos) << fault.text << ": " << message;
  }
  const std::string message = input_error([] { write_extrinsics({}, "rosyaml", false); });
  EXPECT_NE(message.find("ros2-yaml"), std::string::npos) << message;
}

TEST(Extrinsics, ChangeTheirFrame) {
  Rng rng = test_rng();
  for (int round = 0; round < 50; ++round) {
    Extrinsics rig = {"top", {{"left", random_pose(rng, 2.0)}, {"right", random_pose(rng, 2.0)}}};
    rig.poses[0].covariance = random_covariance(rng);
    const RigidTransform T_base_top = random_pose(rng, 2.0);
    Extrinsics in_base = in_frame(rig, "base_link", T_base_top);
    EXPECT_EQ(in_base.parent, "base_link");
    EXPECT_TRUE(is_covariance(in_base.poses[0].covariance->matrix));
    EXPECT_NEAR(in_base.poses[0].covariance->matrix.trace(),
                rig.poses[0].covariance->matrix.trace(), 1e-9);
    in_base.poses.insert(in_base.poses.begin() + 1, {"top", T_base_top});
    const Extrinsics back = in_frame_of_sensor(in_base, "top", "file");
    EXPECT_EQ(back.parent, "top");
    ASSERT_EQ(back.poses.size(), 2U);
    for (const std::size_t i : {0, 1}) {
      EXPECT_EQ(back.poses[i].sensor, rig.poses[i].sensor);
      EXPECT_LT(largest_difference(back.poses[i].T_parent_sensor, rig.poses[i].T_parent_sensor),
                1e-12);
    }
    EXPECT_LT((back.poses[0].covariance->matrix - rig.poses[0].covariance->matrix).norm(), 1e-12);
    // From the frame of one sensor to that of another.
    const Extrinsics of_left = in_frame_of_sensor(in_base, "left", "file");
    for (const ExtrinsicPose& pose : of_left.poses) {
      if (pose.sensor != "top") continue;
      EXPECT_LT(largest_difference(pose.T_parent_sensor, rig.poses[0].T_parent_sensor.inverse()),
                1e-12);
    }
  }
  const Extrinsics without_parent = {"", {{"left", {}}}};
  EXPECT_EQ(in_frame_of_sensor(without_parent, "top", "file").parent, "top");
  const std::string message = input_error([] {
    in_frame_of_sensor({"base_link", {{"lidar_top", {}}}}, "lidar_to", "rig.yaml");
  });
  EXPECT_NE(message.find("rig.yaml: expected the pose of the reference \"lidar_to\""),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("did you mean \"lidar_top\"?"), std::string::npos) << message;
}

}  // namespace
}  // namespace croon::test

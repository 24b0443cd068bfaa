#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "framework/base/angles.hpp"
#include "framework/stage/dataset.hpp"
#include "test/support/data_root.hpp"
#include "test/support/one_point_pcd.hpp"
#include "test/support/stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::vector<Scene> scenes(const fs::path& root, const std::string& path,
                          const std::string& more = "") {
  return test::stage<Dataset>(R"({"type": "opencalib", "path": ")" + path + "\"" + more + "}")
      ->scenes(root);
}

std::string error_of(const fs::path& root, const std::string& path, const std::string& more = "") {
  return test::input_error([&] { scenes(root, path, more); });
}

/// Scenes `rig/b` and `rig/a` of two sensors, made up.
class MadeUpRig : public ::testing::Test {
 protected:
  MadeUpRig() {
    for (const char* scene : {"b", "a"}) {
      const std::string at = std::string("data/rig/") + scene + "/";
      folder.write(at + "top-1.pcd", test::one_point_pcd(1));
      folder.write(at + "left-1-2.pcd", test::one_point_pcd(2));
      folder.write(at + "lidar_cloud_path.txt",
                   "device_id: 1\npath: left-1-2.pcd\ndevice_id: 0\npath: top-1.pcd\n");
    }
    folder.write("data/rig/notes/readme.txt", "no scene");
  }

  test::TempFolder folder;
  const fs::path root = folder.path() / "data";
};

TEST_F(MadeUpRig, IsAFolderOfScenesOrOneScene) {
  const std::vector<Scene> all = scenes(root, "rig");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "a");
  EXPECT_EQ(all[1].name, "b");
  for (const char* path : {"rig/b", "rig/b/", "./rig/../rig/b"}) {
    const std::vector<Scene> one = scenes(root, path);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].name, "b");
    EXPECT_EQ(one[0].reference.sensor, "top");
    EXPECT_EQ(one[0].reference.load().points, (Points{{1, 0, 0}}));
    ASSERT_EQ(one[0].sensors.size(), 1u);
    EXPECT_EQ(one[0].sensors[0].sensor, "left");
    EXPECT_EQ(one[0].sensors[0].load().points, (Points{{2, 0, 0}}));
    EXPECT_FALSE(one[0].sensors[0].truth || one[0].sensors[0].nominal || one[0].sensors[0].initial);
  }
  EXPECT_EQ(scenes(root / "rig" / "a", ".")[0].name, "a");
}

TEST_F(MadeUpRig, HoldsTheScenesThatAreNamed) {
  // What is left out is not read.
  folder.write("data/rig/b/lidar_cloud_path.txt", "no list");
  EXPECT_THAT(error_of(root, "rig"), HasSubstr("rig/b/lidar_cloud_path.txt"));
  const std::vector<Scene> one = scenes(root, "rig", R"(, "scenes": ["a"])");
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].name, "a");
  EXPECT_THAT(error_of(root, "rig", R"(, "scenes": ["a", "c"])"),
              HasSubstr("/scenes/1: expected the name of a scene of the recording, found \"c\"; "
                        "known: a, b"));
  EXPECT_THAT(error_of(root, "rig", R"(, "scenes": ["a", "a"])"),
              HasSubstr("/scenes/1: expected each name once, found \"a\" again"));
}

TEST_F(MadeUpRig, StaysInTheDataRoot) {
  folder.write("outside/lidar_cloud_path.txt", "device_id: 0\npath: top.pcd\n");
  fs::create_directory_symlink(folder.path() / "outside", root / "link");
  fs::create_directory_symlink(root / "rig" / "a", root / "inner");
  for (const std::string& path : {std::string("../outside"), std::string("link"), std::string(".."),
                                  (folder.path() / "outside").string()}) {
    EXPECT_THAT(error_of(root, path), HasSubstr("is outside the data root")) << path;
  }
  EXPECT_EQ(scenes(root, "inner").size(), 1u);
  fs::create_directory_symlink(folder.path() / "outside", root / "rig" / "c");
  EXPECT_THAT(error_of(root, "rig"), HasSubstr("is outside the data root"));
}

TEST_F(MadeUpRig, MayFollowLinksOutOfTheDataRoot) {
  folder.write("disk/top-1.pcd", test::one_point_pcd(5));
  folder.write("disk/left-1-2.pcd", test::one_point_pcd(6));
  folder.write("disk/lidar_cloud_path.txt",
               "device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: left-1-2.pcd\n");
  fs::create_directory_symlink(folder.path() / "disk", root / "rig" / "c");
  fs::create_symlink(folder.path() / "disk/top-1.pcd", root / "rig" / "a" / "far.pcd");
  folder.write("data/rig/a/lidar_cloud_path.txt",
               "device_id: 0\npath: far.pcd\ndevice_id: 1\npath: left-1-2.pcd\n");
  EXPECT_THAT(error_of(root, "rig"), HasSubstr("is outside the data root"));
  const auto follow = [&](const std::string& path) {
    return test::stage<Dataset>(R"({"type": "opencalib", "follow_links": true, "path": ")" + path +
                                "\"}")
        ->scenes(root);
  };
  const std::vector<Scene> all = follow("rig/");
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].reference.load().points, (Points{{5, 0, 0}}));
  EXPECT_EQ(all[2].sensors[0].load().points, (Points{{6, 0, 0}}));
  EXPECT_EQ(all[2].sensors[0].file, (fs::canonical(root) / "rig/c/left-1-2.pcd").string());
  EXPECT_THAT(test::input_error([&] { follow("../disk"); }), HasSubstr("is outside the data root"));
}

TEST_F(MadeUpRig, HasSensorsOfGivenNames) {
  folder.write("data/rig/a/lidar_cloud_path.txt",
               "device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: left-1-2.pcd\nsensor: "
               "front-left\n");
  folder.write("data/rig/truth.json",
               R"({"front-left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [1, 0, 0]}})");
  const std::vector<Scene> all = scenes(root, "rig/a");
  EXPECT_EQ(all[0].reference.sensor, "top");
  EXPECT_EQ(all[0].sensors[0].sensor, "front-left");
  EXPECT_TRUE(all[0].sensors[0].truth);
}

TEST_F(MadeUpRig, NeedsAFolderWithScenes) {
  EXPECT_THAT(error_of(root, "none"), HasSubstr("expected a file or folder, found none"));
  EXPECT_THAT(error_of(root, "rig/notes"),
              HasSubstr("expected folders with lidar_cloud_path.txt, found none"));
  EXPECT_THAT(error_of(root, "rig/notes/readme.txt"), HasSubstr("expected a folder of scenes"));
  EXPECT_THAT(error_of(root / "none", "rig"), HasSubstr("expected the data folder"));
  EXPECT_THAT(test::input_error([] { test::build_stage("dataset", R"({"type": "opencalib"})"); }),
              HasSubstr("the key \"path\" is missing"));
}

TEST_F(MadeUpRig, FindsCloudsWhereverTheListWasWritten) {
  for (const char* path : {"left-1-2.pcd", "a/left-1-2.pcd", "rig/a/left-1-2.pcd", "./left-1-2.pcd",
                           "test_data/elsewhere/left-1-2.pcd", "/home/author/left-1-2.pcd",
                           "..\\\\a\\\\left-1-2.pcd"}) {
    std::string entry = path;
    while (entry.find("\\\\") != std::string::npos) entry.replace(entry.find("\\\\"), 2, "\\");
    folder.write("data/rig/a/lidar_cloud_path.txt",
                 "device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: " + entry + "\n");
    EXPECT_EQ(scenes(root, "rig/a")[0].sensors[0].load().points, (Points{{2, 0, 0}})) << entry;
  }
}

TEST_F(MadeUpRig, SaysWhatIsThereInPlaceOfACloud) {
  ASSERT_EQ(::mkfifo((root / "rig/a/pipe.pcd").c_str(), 0600), 0);
  folder.write("data/rig/a/lidar_cloud_path.txt",
               "device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: pipe.pcd\n");
  EXPECT_THAT(error_of(root, "rig/a"),
              HasSubstr("expected a cloud, found something that is not a file at " +
                        (root / "rig/a/pipe.pcd").string()));
}

TEST_F(MadeUpRig, SaysWhatIsWrongWithAScene) {
  folder.write("data/rig/a/top-9.pcd", test::one_point_pcd(9));
  folder.write("data/rig/a/bad.pcd", "FIELDS x y\n");
  folder.write("secret.pcd", test::one_point_pcd(3));
  const std::pair<const char*, const char*> cases[] = {
      {"device_id: 1\npath: left-1-2.pcd\n", "the reference, device 0, is missing"},
      {"device_id: 0\npath: top-1.pcd\n", "expected a sensor besides the reference"},
      {"device_id: 0\npath: top-1.pcd\ndevice_id: 0\npath: left-1-2.pcd\n",
       "line 4: duplicate device 0"},
      {"device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: top-9.pcd\n",
       "lidar_cloud_path.txt: line 4: duplicate sensor name \"top\""},
      {"device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: x/right.pcd\n",
       "lidar_cloud_path.txt: line 4: the cloud \"x/right.pcd\" is neither"},
      {"device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: ../../../secret.pcd\n",
       "line 4: the cloud"},
      {"device_id: 0\npath: top-1.pcd\ndevice_id: 1\npath: bad.pcd\n", "bad.pcd: the header ends"},
  };
  for (const auto& [list, message] : cases) {
    folder.write("data/rig/a/lidar_cloud_path.txt", list);
    EXPECT_THAT(error_of(root, "rig/a"), HasSubstr(message)) << list;
  }
}

TEST_F(MadeUpRig, ReportsTheFaultsOfAllScenesOnce) {
  folder.write("data/rig/a/top-1.pcd", "");
  folder.write("data/rig/b/left-1-2.pcd", "");
  folder.write("data/rig/truth.json", R"({"left": {}})");
  folder.write("data/rig/b/initial_extrinsic.txt", "nonsense\n");
  try {
    scenes(root, "rig");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    // Two clouds, two missing keys of the truth that both scenes share, one list of starts.
    EXPECT_EQ(error.faults().size(), 5u) << error.what();
  }
}

TEST_F(MadeUpRig, TakesPosesFromTheNearestFile) {
  const auto pose = [](int x) {
    return R"({"left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [)" + std::to_string(x) +
           ", 0, 0]}}";
  };
  folder.write("data/truth.json", pose(1));
  folder.write("data/rig/nominal.json", pose(2));
  folder.write("data/rig/a/nominal.json", pose(3));
  folder.write("data/rig/a/initial_extrinsic.txt",
               "device_id: 0\n(Roll,Pitch,Yaw,tx,ty,tz): 0 0 0 0 0 0\n"
               "device_id: 1\n(Roll,Pitch,Yaw,tx,ty,tz): 0 0 90 4 0 0\n");
  folder.write("truth.json", "outside the data root");
  const std::vector<Scene> all = scenes(root, "rig");
  const SensorScan &a = all[0].sensors[0], &b = all[1].sensors[0];
  EXPECT_EQ(a.truth->translation.x(), 1.0);
  EXPECT_EQ(b.truth->translation.x(), 1.0);
  EXPECT_EQ(a.nominal->translation.x(), 3.0);
  EXPECT_EQ(b.nominal->translation.x(), 2.0);
  EXPECT_EQ(a.initial->translation.x(), 4.0);
  EXPECT_NEAR(rotation_angle(a.initial->rotation), kPi / 2, 1e-12);
  EXPECT_FALSE(b.initial);
  folder.write("data/rig/b/initial_extrinsic.txt",
               "device_id: 0\n(Roll,Pitch,Yaw,tx,ty,tz): 1 0 0 0 0 0\n");
  EXPECT_THAT(error_of(root, "rig"), HasSubstr("line 2: expected zeros for the reference"));
}

TEST_F(MadeUpRig, TakesKindsFromTheNearestFile) {
  EXPECT_EQ(scenes(root, "rig")[0].kind, "");
  folder.write("data/scene_kinds.json", R"({"a": "urban", "b": "car_park-2", "elsewhere": "x"})");
  EXPECT_EQ(scenes(root, "rig")[0].kind, "urban");
  EXPECT_EQ(scenes(root, "rig")[1].kind, "car_park-2");
  EXPECT_EQ(scenes(root, "rig/b")[0].kind, "car_park-2");
  folder.write("data/rig/a/scene_kinds.json", R"({"a": "narrow"})");
  folder.write("data/rig/b/scene_kinds.json", "{}");
  EXPECT_EQ(scenes(root, "rig")[0].kind, "narrow");
  EXPECT_EQ(scenes(root, "rig")[1].kind, "");
}

TEST_F(MadeUpRig, SaysWhatIsWrongWithKinds) {
  const std::string expected =
      "expected a word of letters, digits, \"_\" and \"-\" that does not begin with \"-\", found ";
  const std::pair<const char*, std::string> cases[] = {
      {R"({"a": ""})", "scene_kinds.json: /a: " + expected + "\"\""},
      {R"({"a": "car park"})", "scene_kinds.json: /a: " + expected + "\"car park\""},
      {R"({"a": "-2"})", "scene_kinds.json: /a: " + expected + "\"-2\""},
      {R"({"b": "straße"})", "scene_kinds.json: /b: " + expected},
      {R"({"elsewhere": 7})", "scene_kinds.json: /elsewhere: " + expected + "7"},
      {R"({"a": "x", "a": "y"})", "scene_kinds.json: /a: "},
      {R"(["urban"])", "scene_kinds.json: /: expected an object"},
      {"urban", "scene_kinds.json: "},
  };
  for (const auto& [text, message] : cases) {
    folder.write("data/rig/scene_kinds.json", text);
    EXPECT_THAT(error_of(root, "rig"), HasSubstr(message)) << text;
  }
  folder.write("data/rig/scene_kinds.json", R"({"a": 1, "b": {}})");
  try {
    scenes(root, "rig");
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    // Both scenes share the file; its faults come once.
    EXPECT_EQ(error.faults().size(), 2u) << error.what();
  }
}

TEST(Opencalib, ReadsTheAuthorsSamples) {
  CROON_SKIP_WITHOUT_DATA();
  const std::vector<Scene> carla = scenes(test::data_root(), "opencalib/carla");
  ASSERT_GE(carla.size(), 2u);
  EXPECT_EQ(carla[0].name, "004069");
  EXPECT_EQ(carla[0].reference.load().points.size(), 89021u);
  ASSERT_EQ(carla[0].sensors.size(), 4u);
  for (const SensorScan& scan : carla[0].sensors) {
    EXPECT_TRUE(scan.truth && scan.initial && !scan.nominal) << scan.sensor;
  }
  EXPECT_EQ(carla[0].sensors[0].sensor, "front");
  EXPECT_EQ(carla[0].sensors[0].truth->translation, Eigen::Vector3d(2.9, 0.15, -1.195));
  const std::vector<Scene> real = scenes(test::data_root(), "opencalib/real/0002");
  ASSERT_EQ(real.size(), 1u);
  ASSERT_EQ(real[0].sensors.size(), 2u);
  EXPECT_TRUE(real[0].sensors[1].nominal && !real[0].sensors[1].truth);
  EXPECT_EQ(real[0].sensors[1].load().points.size(), 9487u);
}

}  // namespace
}  // namespace croon

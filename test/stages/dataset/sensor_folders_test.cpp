#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "framework/stage/dataset.hpp"
#include "test/support/one_point_pcd.hpp"
#include "test/support/stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A folder for each of three sensors.
class SensorFolders : public ::testing::Test {
 protected:
  SensorFolders() {
    folder.write("data/car/top/000002.pcd", test::one_point_pcd(1));
    folder.write("data/car/top/000001.pcd", test::one_point_pcd(2));
    folder.write("data/car/top/000003.pcd", test::one_point_pcd(9));
    folder.write("data/car/front-left/000001.pcd", test::one_point_pcd(3));
    folder.write("data/car/front-left/000002.pcd", test::one_point_pcd(4));
    folder.write("data/car/back/000002.pcd", test::one_point_pcd(5));
    folder.write("data/car/back/notes.txt", "none");
    folder.write("data/car/pictures/000001.png", "");
    folder.write("data/car/truth.json",
                 R"({"front-left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [1, 0, 0]}})");
    folder.write("data/scene_kinds.json", R"({"000002": "urban"})");
  }

  std::vector<Scene> scenes(const std::string& more = "") const {
    return test::stage<Dataset>(R"({"type": "sensor_folders", "path": "car", "reference": "top")" +
                                more + "}")
        ->scenes(root);
  }
  std::string error(const std::string& more = "") const {
    return test::input_error([&] { scenes(more); });
  }

  test::TempFolder folder;
  const fs::path root = folder.path() / "data";
};

TEST_F(SensorFolders, HoldCloudsOfOneNameForEachScene) {
  const std::vector<Scene> all = scenes();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].name, "000001");
  EXPECT_EQ(all[0].kind, "");
  ASSERT_EQ(all[0].sensors.size(), 1U);
  EXPECT_EQ(all[0].sensors[0].sensor, "front-left");
  ASSERT_TRUE(all[0].sensors[0].truth);
  EXPECT_EQ(all[0].sensors[0].truth->translation.x(), 1.0);
  EXPECT_EQ(all[0].sensors[0].load().points, (Points{{3, 0, 0}}));
  EXPECT_EQ(all[1].kind, "urban");
  EXPECT_EQ(all[1].reference.sensor, "top");
  EXPECT_EQ(all[1].reference.load().points, (Points{{1, 0, 0}}));
  ASSERT_EQ(all[1].sensors.size(), 2U);
  EXPECT_EQ(all[1].sensors[0].sensor, "back");
  EXPECT_FALSE(all[1].sensors[0].truth);
  EXPECT_EQ(all[1].sensors[1].sensor, "front-left");
}

TEST_F(SensorFolders, HavePosesInTheFrameOfTheReference) {
  const std::string left =
      R"("front-left": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [1, 0, 0]})";
  folder.write(
      "data/car/truth.json",
      R"({"top": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 0]}, )" + left + "}");
  EXPECT_EQ(scenes().size(), 2U);
  folder.write(
      "data/car/nominal.json",
      R"({"top": {"rotation_rpy_deg": [0, 0, 0], "translation_m": [0, 0, 1.8]}, )" + left + "}");
  EXPECT_THAT(error(), HasSubstr("nominal.json: /top: expected zeros"));
}

TEST_F(SensorFolders, AreThoseThatAreNamed) {
  const std::vector<Scene> some = scenes(R"(, "sensors": ["back"])");
  ASSERT_EQ(some.size(), 1U);
  EXPECT_EQ(some[0].sensors.size(), 1U);
  EXPECT_THAT(error(R"(, "sensors": ["none"])"), HasSubstr("car/none"));
  EXPECT_THAT(error(R"(, "sensors": ["pictures"])"), HasSubstr("expected clouds of the same name"));
  EXPECT_THAT(error(R"(, "sensors": ["../.."])"), HasSubstr("a name in UTF-8 without slashes"));
}

TEST_F(SensorFolders, AreEachAnotherSensor) {
  EXPECT_THAT(error(R"(, "sensors": ["back", "front-left", "back"])"),
              HasSubstr("/sensors/2: expected each name once, found \"back\" again"));
  EXPECT_THAT(error(R"(, "sensors": ["back", "top"])"),
              HasSubstr("/sensors/1: expected another sensor than the reference, found \"top\""));
}

TEST_F(SensorFolders, HoldTheScenesThatAreNamed) {
  const std::vector<Scene> one = scenes(R"(, "scenes": ["000002"])");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].name, "000002");
  EXPECT_EQ(scenes(R"(, "scenes": ["000002", "000001"])").at(0).name, "000001");
  // A cloud of the reference alone is no scene.
  EXPECT_THAT(error(R"(, "scenes": ["000002", "000003"])"), HasSubstr("found \"000003\""));
  EXPECT_THAT(
      error(R"(, "scenes": ["000002", "00002"])"),
      HasSubstr("/scenes/1: expected the name of a scene of the recording, found \"00002\"; "
                "did you mean \"000002\"?"));
  EXPECT_THAT(error(R"(, "scenes": ["000002", "000002"])"),
              HasSubstr("/scenes/1: expected each name once, found \"000002\" again"));
}

TEST_F(SensorFolders, AreFoundByTheNearestName) {
  const std::string text = error(R"(, "sensors": ["back", "frnt-left"])");
  EXPECT_THAT(text, HasSubstr("/sensors/1: expected the folder of a sensor, found no "));
  EXPECT_THAT(text, HasSubstr("car/frnt-left; did you mean \"front-left\"?"));
  EXPECT_THAT(error(R"(, "sensors": ["xyz"])"), HasSubstr("; known: back, front-left, top"));
}

TEST_F(SensorFolders, NameWhatIsWrong) {
  folder.write("data/car/back/000002.ply", "ply\n");
  EXPECT_THAT(error(), HasSubstr("expected one cloud of this name, also found "));
  fs::remove(root / "car/back/000002.ply");
  folder.write("data/car/back/000002.pcd", "FIELDS x\n");
  EXPECT_THAT(error(), HasSubstr("car/back/000002.pcd"));
}

TEST_F(SensorFolders, MissNoLinkThatLeadsNowhere) {
  for (const char* name : {"data/car/back/000001.pcd", "data/car/right"}) {
    const fs::path link = folder.path() / name;
    fs::create_symlink("/a-disk-that-is-not-there/data", link);
    for (const char* more : {"", R"(, "follow_links": true)"}) {
      EXPECT_EQ(error(more), link.string() + ": expected a file or folder, found a dangling link");
    }
    fs::remove(link);
  }
  fs::create_directory(folder.path() / "data/car/back/000001.pcd");
  EXPECT_THAT(error(), HasSubstr("000001.pcd: expected a cloud, found a folder"));
}

TEST_F(SensorFolders, ScenesAreInTheOrderOfTheirNumbers) {
  for (const char* name : {"1000000", "999999", "000003a"}) {
    for (const char* sensor : {"top", "back"}) {
      folder.write(std::string("data/car/") + sensor + "/" + name + ".pcd", test::one_point_pcd(1));
    }
  }
  std::vector<std::string> names;
  for (const Scene& scene : scenes()) names.push_back(scene.name);
  EXPECT_EQ(names, (std::vector<std::string>{"000001", "000002", "999999", "1000000", "000003a"}));
}

TEST_F(SensorFolders, HaveNamesThatTablesCanShow) {
  EXPECT_THAT(error(R"(, "sensors": ["-left"])"),
              HasSubstr("/sensors/0: expected a sensor with a name in UTF-8"));
  EXPECT_THAT(test::input_error([] {
                test::build_stage(
                    "dataset", R"({"type": "sensor_folders", "path": "x", "reference": "=top"})");
              }),
              HasSubstr("/reference: expected a sensor with a name in UTF-8"));
}

TEST_F(SensorFolders, FollowLinksIfAsked) {
  folder.write("disk/000002.pcd", test::one_point_pcd(7));
  fs::remove_all(root / "car/back");
  fs::create_directory_symlink(folder.path() / "disk", root / "car/back");
  EXPECT_THAT(error(), HasSubstr("is outside the data root"));
  const std::vector<Scene> all = scenes(R"(, "follow_links": true)");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].sensors[0].load().points, (Points{{7, 0, 0}}));
  EXPECT_EQ(all[1].sensors[0].file, (fs::canonical(root) / "car/back/000002.pcd").string());
}

}  // namespace
}  // namespace croon

#include "framework/calibration/recorded_scenes.hpp"

#include <gtest/gtest.h>

#include "test/support/one_point_pcd.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

class RecordedScenes : public testing::Test {
 protected:
  std::string write(const std::string& name) const {
    return folder_.write(name, one_point_pcd(1)).string();
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// "reference: sensor, sensor" of a scene.
  static std::string sensors_of(const Scene& scene) {
    std::string text = scene.reference.sensor + ":";
    for (const SensorScan& scan : scene.sensors) text += " " + scan.sensor;
    return text;
  }

  TempFolder folder_;
};

TEST_F(RecordedScenes, NameSensorsAfterFilesOrTheirFolders) {
  const auto by_file = recorded_scenes({write("top.pcd"), write("left.pcd"), "r=" + write("x.pcd")},
                                       {"left", 0.05, 10});
  ASSERT_EQ(by_file.scenes.size(), 1U);
  EXPECT_EQ(sensors_of(by_file.scenes.front()), "left: top r");
  const auto by_folder = recorded_scenes({write("a/1.pcd"), write("b/1.pcd")}, {});
  EXPECT_EQ(sensors_of(by_folder.scenes.front()), "a: b");
}

TEST_F(RecordedScenes, PairTheCloudsOfFolders) {
  for (const char* const scene : {"0", "1", "2", "3", "4", "5"}) {
    write(std::string("rig/top/") + scene + ".pcd");
    if (*scene != '3') write(std::string("rig/left/") + scene + ".pcd");
  }
  folder_.write("rig/left/readme.md", "not a cloud");
  const auto all = recorded_scenes({path("rig/top/"), path("rig/left")}, {"", 0.05, 10});
  EXPECT_EQ(all.scenes.size(), 5U);
  EXPECT_EQ(all.unused.size(), 1U);
  const auto some = recorded_scenes({path("rig")}, {"top", 0.05, 2});
  ASSERT_EQ(some.scenes.size(), 2U);
  EXPECT_EQ(sensors_of(some.scenes.front()), "top: left");
  EXPECT_EQ(some.unused.size(), 2U);
  EXPECT_EQ(some.scenes.front().reference.load().size(), 1U);
}

TEST_F(RecordedScenes, TakeNumberedFoldersOfSensorsForScenes) {
  for (const char* const file : {"000000/top", "000000/left", "000001/top", "000002/left"}) {
    write("drive/" + std::string(file) + ".pcd");
  }
  const auto recorded = recorded_scenes({path("drive")}, {"top", 0.05, 10});
  ASSERT_EQ(recorded.scenes.size(), 1U);
  EXPECT_EQ(recorded.scenes.front().name, "000000");
  EXPECT_EQ(sensors_of(recorded.scenes.front()), "top: left");
  EXPECT_EQ(recorded.unused.size(), 2U);
}

}  // namespace
}  // namespace croon::test

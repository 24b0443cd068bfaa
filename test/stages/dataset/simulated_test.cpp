#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "framework/stage/dataset.hpp"
#include "test/support/stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

std::vector<Scene> scenes_of(const std::string& members) {
  return stage<Dataset>(R"({"type": "simulated", )" + members + "}")->scenes("nowhere");
}

TEST(Simulated, HasTheScenesSensorsAndTruthOfItsRig) {
  const std::vector<Scene> scenes = scenes_of(R"("scenes": 3, "mix": {"urban": 1})");
  ASSERT_EQ(scenes.size(), 3U);
  EXPECT_EQ(scenes[2].name, "000002");
  EXPECT_EQ(scenes[2].kind, "urban");
  EXPECT_EQ(scenes[0].reference.sensor, "top");
  ASSERT_EQ(scenes[0].sensors.size(), 4U);
  for (const SensorScan& scan : scenes[0].sensors) {
    ASSERT_TRUE(scan.truth.has_value());
    EXPECT_TRUE(scan.file.empty());
  }
  EXPECT_EQ(scenes[0].sensors[1].sensor, "front");
  EXPECT_EQ(scenes[0].sensors[1].truth->translation, Eigen::Vector3d(2.9, 0.15, -1.195));
}

TEST(Simulated, ASceneIsTheSameWhicheverComeWithIt) {
  const std::vector<Scene> many = scenes_of(R"("scenes": 9)");
  const std::vector<Scene> one = scenes_of(R"("scenes": 1, "first_scene": 7)");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].name, many[7].name);
  EXPECT_EQ(one[0].kind, many[7].kind);
  // More scenes than are kept in memory, and the asked one again.
  const Points first = many[7].sensors[0].load().points;
  for (const Scene& scene : many) EXPECT_FALSE(scene.reference.load().points.empty());
  EXPECT_EQ(many[7].sensors[0].load().points, first);
  EXPECT_EQ(one[0].sensors[0].load().points, first);
}

TEST(Simulated, TakesARigFromJson) {
  const std::vector<Scene> scenes = scenes_of(R"("scenes": 1, "noise": "real", "rig": {
      "reference": "roof", "reference_height_m": 1.8, "sensors": {
        "roof": {"model": "spinner_32"},
        "nose": {"model": {"like": "solid_state", "max_range_m": 60}, "translation_m": [2, 0, -1]}
      }})");
  ASSERT_EQ(scenes[0].sensors.size(), 1U);
  EXPECT_EQ(scenes[0].reference.sensor, "roof");
  const LoadedCloud cloud = scenes[0].sensors[0].load();
  ASSERT_FALSE(cloud.points.empty());
  const std::vector<double> ring = channel_values(cloud, kRing);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    EXPECT_LT(cloud.points[i].norm(), 61.0F);
    EXPECT_GT(cloud.points[i].x(), 0.0F);
    EXPECT_LT(ring[i], 126.0);
  }
}

TEST(Simulated, SaysWhatIsWrongAndWhere) {
  const std::pair<const char*, const char*> cases[] = {
      {R"("rig": "croon_fiv")", "/rig"},
      {R"("mix": {"urban": 0})", "/mix: at least one weight"},
      {R"("mix": {"urbn": 1})", "/mix/urbn"},
      {R"("noise": {"range_std_m": -1})", "/noise/range_std_m"},
      {R"("scenes": 0)", "/scenes"},
      {R"("rig": {"sensors": {"top": {"model": "pandar64"}}})", "/rig: sensors must have"},
      {R"("rig": {"sensors": {"top": {"translation_m": [1, 0, 0]}, "a": {}}})",
       "/rig: sensors must have the reference"},
      {R"("rig": {"sensors": {"top": {"time_offset_s": 0.05}, "a": {}}})",
       "/rig: sensors must have the reference"},
      {R"("rig": {"sensors": {"top": {}, "a": {"translation_m": [0, 0]}}})",
       "/rig/sensors/a: translation_m must have three"},
      {R"("rig": {"sensors": {"top": {}, "a": {"model": "pandar"}}})", "/rig/sensors/a/model"}};
  for (const auto& [members, message] : cases) {
    const std::string error = input_error([&, json = members] { scenes_of(json); });
    EXPECT_NE(error.find(message), std::string::npos) << members << " gave: " << error;
  }
}

}  // namespace
}  // namespace croon::test

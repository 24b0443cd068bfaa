#include "experiments/run/sensor_pairs.hpp"

#include <gtest/gtest.h>

#include "experiments/run/scene_groups.hpp"
#include "framework/geometry/dof.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

Experiment with_loops(const std::string& loops, int sensors = 3) {
  const test::TempFolder folder;
  return load_experiment(
      folder.write("x.json", R"({"name": "x", "dataset": {"type": "fake", "sensors": )" +
                                 std::to_string(sensors) + "}, " + loops +
                                 R"( "pipeline": [{"step": "behave"}]})"),
      test::fake_catalogue());
}

TEST(SensorPairs, AreThereWhereLoopsAreAskedFor) {
  EXPECT_EQ(scene_groups(with_loops(""), "").front().pairs.size(), 3U);
  EXPECT_EQ(scene_groups(with_loops(R"("loops": false,)"), "").front().pairs.size(), 3U);
  const SceneGroup group = scene_groups(with_loops(R"("loops": true,)"), "").front();
  ASSERT_EQ(group.scenes.size(), 1U);
  EXPECT_EQ(group.scenes.front().sensors.size(), 3U);
  std::vector<std::string> names;
  for (const SensorPair& pair : group.pairs) {
    names.push_back(pair.name + " of " + pair.source + " in " + pair.target);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"s2 of s2 in top", "s1 of s1 in top",
                                             "s0 of s0 in top", "s1>s2 of s1 in s2",
                                             "s0>s2 of s0 in s2", "s0>s1 of s0 in s1"}));
}

TEST(SensorPairs, AreNoMoreThanAStoreMayHave) {
  const auto error = [](int sensors) {
    const std::string line =
        test::input_error([&] { scene_groups(with_loops(R"("loops": true,)", sensors), ""); });
    return line.substr(line.find(": ") + 2);
  };
  EXPECT_NO_THROW(scene_groups(with_loops(R"("loops": true,)", 140), ""));
  EXPECT_EQ(error(141).substr(0, 78),
            "/loops: expected at most 10000 sensors and pairs of them, found 10011 in scene");
  EXPECT_NO_THROW(scene_groups(with_loops("", 141), ""));
}

TEST(SensorPairs, HaveTheRelativePose) {
  for (const SceneGroup& group : scene_groups(with_loops(R"("loops": true,)"), "")) {
    const auto truth = [&](std::size_t i) { return *group.pairs[i].truth; };
    // T_reference_s2 T_s2_s0 = T_reference_s0.
    const PoseError error = pose_error(truth(0) * truth(4), truth(2));
    EXPECT_LT(error.rotation_rad, 1e-12);
    EXPECT_LT(error.translation_m, 1e-12);
  }
}

std::vector<Scene> scenes_with(const std::vector<std::string>& sensors) {
  Scene scene;
  scene.name = "s";
  scene.reference.sensor = "top";
  for (const std::string& name : sensors) scene.sensors.emplace_back().sensor = name;
  return {scene};
}

TEST(SensorPairs, HaveSensorsWithNamesOfTheirOwn) {
  const auto error = [](const std::vector<std::string>& sensors) {
    return test::input_error([&] { check_names(scenes_with(sensors), "x.json"); });
  };
  EXPECT_NO_THROW(check_names(scenes_with({"left", "right"}), "x.json"));
  EXPECT_EQ(error({"left", "left"}),
            "x.json: expected sensors with different names in scene \"s\", found \"left\" twice");
  EXPECT_EQ(error({"top"}),
            "x.json: expected sensors with different names in scene \"s\", found \"top\" twice");
  EXPECT_NO_THROW(check_names(scenes_with({std::string(251, 's')}), "x.json"));
  EXPECT_EQ(error({std::string(252, 's')}),
            "x.json: expected a sensor with a name of at most 251 bytes, found one of 252")
      << "Its cloud is a file NAME.pcd.";
  EXPECT_EQ(error({"all"}),
            "x.json: /dataset: expected a sensor name other than \"all\", which means all sensors "
            "together");
}

TEST(SensorPairs, AreKnownByTheirNames) {
  // The names of sensors are the user's: they may have any character.
  for (const char* source : {"left", "a>b", ""}) {
    for (const char* target : {"front", ">", "x>"}) {
      const SensorPair pair = sensor_pair(source, target);
      const SensorPair named = named_pair(pair.name, target);
      EXPECT_EQ(named.source, source);
      EXPECT_EQ(named.target, target);
    }
  }
}

}  // namespace
}  // namespace croon::experiments

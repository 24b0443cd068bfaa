// Trials that calibrate a rig from several scenes, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using ::testing::HasSubstr;

class RigRun : public testing::Test {
 protected:
  /// Runs an experiment with groups of so many of its five scenes.
  Answer run(int scenes_per_trial, const std::string& options = "") {
    const std::string file = folder_.write("rigs.json", R"({
      "name": "rigs", "dataset": {"type": "simulated", "rig": "croon_three", "scenes": 5},
      "scenes_per_trial": )" + std::to_string(scenes_per_trial) +
                                                            R"(,
      "starts": {"rotation_deg": 0, "translation_m": 0, "trials": 1},
      "pipeline": [{"step": "identity"}, {"step": "consensus"}]})");
    return croon("run \"" + file + "\" --out \"" + out().string() + "\" --quiet " + options);
  }

  /// The groups in the manifest of a run that must have ended well.
  std::string groups_after(const Answer& answer) const {
    EXPECT_EQ(answer.code, 0) << answer.text;
    return nlohmann::json::parse(read_whole_file(out() / "manifest.json")).at("groups").dump();
  }

  std::filesystem::path out() const { return folder_.path() / "out"; }

  test::TempFolder folder_;
};

TEST_F(RigRun, SaysWhatAGroupIs) {
  const Answer answer = run(2);
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_THAT(answer.text, HasSubstr("Each trial calibrates the rig from 2 scenes"));
  const auto manifest = nlohmann::json::parse(read_whole_file(out() / "manifest.json"));
  ASSERT_EQ(manifest.at("groups").size(), 2U);
  for (const auto& [name, scenes] : manifest.at("groups").items()) {
    EXPECT_EQ(scenes.size(), 2U);
    EXPECT_EQ(name, scenes[0].get<std::string>() + "+1");
  }
  const Answer table = croon("export \"" + out().string() + "\" --format md");
  EXPECT_EQ(table.code, 0);
  EXPECT_THAT(table.text, HasSubstr("2 groups of 2 scenes"));
}

TEST_F(RigRun, EveryPictureAndCloudIsMade) {
  const Answer answer = run(2, "--png --clouds");
  EXPECT_EQ(answer.code, 0) << answer.text;
  EXPECT_TRUE(std::filesystem::exists(out() / "before_after.png"));
  EXPECT_FALSE(std::filesystem::is_empty(out() / "clouds"));
}

TEST_F(RigRun, SimulatedScenesHaveTheSameGroupsAndStarts) {
  const std::string before = groups_after(run(2));
  const std::string trials = read_whole_file(out() / "trials.csv");
  const std::filesystem::path scenes = folder_.path() / "scenes";
  const Answer written = croon("simulate \"" + (folder_.path() / "rigs.json").string() +
                               "\" --out \"" + scenes.string() + "\" --quiet");
  ASSERT_EQ(written.code, 0) << written.text;
  EXPECT_THAT(written.text, HasSubstr("5 scenes are in"));
  const Answer again =
      croon("run \"" + (scenes / "experiment.json").string() + "\" --data \"" + scenes.string() +
            "\" --out \"" + out().string() + "\" --fresh --quiet");
  EXPECT_EQ(groups_after(again), before);
  EXPECT_EQ(read_whole_file(out() / "trials.csv"), trials);
}

TEST_F(RigRun, IsRefusedWithFewerScenesThanAGroupHas) {
  const Answer answer = run(6);
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text,
              HasSubstr("rigs.json: /scenes_per_trial: expected at most the number of scenes, 5"));
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(RigRun, GroupsOfAnotherSizeDoNotGoIntoOneStore) {
  ASSERT_EQ(run(2).code, 0);
  const Answer other = run(5);
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.text, HasSubstr("scenes_per_trial"));
  EXPECT_EQ(run(2).code, 0);
  const Answer single = run(1);
  EXPECT_EQ(single.code, 2);
  EXPECT_THAT(single.text, HasSubstr("scenes_per_trial"));
}

TEST_F(RigRun, AKnownErrorOfNoSensorIsRefused) {
  const std::string file = folder_.write("known.json", R"({
    "name": "known", "dataset": {"type": "simulated", "rig": "croon_three", "scenes": 1},
    "pipeline": [{"step": "azimuth_calibration", "known": {"lift": {"offset_deg": 0.1},
                                                           "top": {"offset_deg": 0.1}}}]})");
  const Answer answer = croon("run \"" + file + "\" --out \"" + out().string() + "\" --quiet");
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text, "croon: " + file +
                             ": the step \"azimuth_calibration\": expected a sensor of the "
                             "dataset, found \"lift\"; did you mean \"left\"?\n");
  EXPECT_FALSE(std::filesystem::exists(out()));
}

TEST_F(RigRun, ScenesOfDifferentReferencesAreRefused) {
  const std::string point =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n1 2 3\n";
  for (const char* const sensor : {"top", "left"}) {
    folder_.write("data/rig/s1/" + std::string(sensor) + ".pcd", point);
  }
  folder_.write("data/rig/s1/lidar_cloud_path.txt",
                "device_id: 0\npath: rig/s1/top.pcd\ndevice_id: 1\npath: rig/s1/left.pcd\n");
  folder_.write("data/rig/s2/lidar_cloud_path.txt",
                "device_id: 0\npath: rig/s1/left.pcd\ndevice_id: 1\npath: rig/s1/top.pcd\n");
  const std::string file = folder_.write("two.json", R"({
    "name": "two", "dataset": {"type": "opencalib", "path": "rig"},
    "pipeline": [{"step": "identity"}]})");
  const Answer answer = croon("run \"" + file + "\" --data \"" + folder_.path().string() +
                              "/data\" --out \"" + out().string() + "\" --quiet");
  EXPECT_EQ(answer.code, 2);
  EXPECT_THAT(answer.text, HasSubstr("two.json: /dataset: expected one reference in all scenes, "
                                     "found \"top\" in scene \"s1\" and \"left\" in \"s2\""));
}

}  // namespace
}  // namespace croon::experiments

#include "framework/calibration/calibrate_rig.hpp"

#include <gtest/gtest.h>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/calibration/composition.hpp"
#include "framework/calibration/reasons_in_words.hpp"
#include "registry/registry.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

SensorScan scan_of(const std::string& sensor, const Points& points) {
  SensorScan scan;
  scan.sensor = sensor;
  scan.load = [points] {
    LoadedCloud cloud;
    cloud.points = points;
    return cloud;
  };
  return scan;
}

SensorScan damaged_scan(const std::string& sensor) {
  SensorScan scan;
  scan.sensor = sensor;
  scan.load = []() -> LoadedCloud { throw InputError("x.pcd", "line 3", "expected a number"); };
  return scan;
}

/// Scenes of two sensors in streets without times: "top" and, at `T_top_left`, "left".
std::vector<Scene> street_scenes(const RigidTransform& T_top_left, std::uint64_t count) {
  const RigidTransform T_top_street{rotation_from_rpy({0.01, -0.02, 0.3}), {0.0, 0.0, -2.0}};
  std::vector<Scene> scenes;
  for (std::uint64_t i = 0; i < count; ++i) {
    Rng rng = test_rng(i + 1);
    const StreetPair pair = street_pair(rng, i + 1, T_top_left, 12000, 9000, 0.01, T_top_street);
    Scene scene;
    scene.name = std::to_string(i);
    scene.reference = scan_of("top", pair.target);
    scene.sensors = {scan_of("left", pair.source)};
    scenes.push_back(std::move(scene));
  }
  return scenes;
}

const RigidTransform kLeft = {rotation_from_rpy({0.4, -0.3, 1.9}), {-0.3, 0.8, -0.4}};

CalibratedRig calibrated(const std::vector<Scene>& scenes, int jobs = 2,
                         const std::string& pipeline = "best") {
  CalibrationOptions options;
  options.jobs = jobs;
  options.pipeline = pipeline;
  return calibrate_rig(scenes, options, registry());
}

void expect_near(const RigidTransform& T, const RigidTransform& truth) {
  const PoseError error = pose_error(T, truth);
  EXPECT_LT(error.rotation_rad, rad_from_deg(0.3));
  EXPECT_LT(error.translation_m, 0.05);
}

TEST(CalibrateRig, GivesOnePosePerSensorFromAllScenesForAnyNumberOfThreads) {
  const std::vector<Scene> scenes = street_scenes(kLeft, 2);
  const CalibratedRig rig = calibrated(scenes);
  ASSERT_EQ(rig.sensors.size(), 1U);
  const CalibratedSensor& left = rig.sensors.front();
  EXPECT_TRUE(left.is_accepted) << (left.reasons.empty() ? "" : left.reasons.front());
  EXPECT_EQ(left.scenes.size(), 2U);
  ASSERT_TRUE(left.T_reference_sensor && left.covariance);
  expect_near(*left.T_reference_sensor, kLeft);
  ASSERT_TRUE(left.error_budget && left.scenes[0].error_budget);
  EXPECT_TRUE(is_covariance(*left.error_budget));
  // The budget does not fall with the number of scenes, and it is a part of the covariance.
  EXPECT_GT(left.error_budget->trace(), 0.5 * left.scenes[0].error_budget->trace());
  EXPECT_TRUE(is_covariance(left.covariance->matrix - *left.error_budget));
  EXPECT_EQ(rig.reference, "top");
  EXPECT_EQ(rig.composition, "best");
  EXPECT_NE(rig.composition_reason.find("has no times"), std::string::npos);
  const CalibratedRig again = calibrated(scenes, 1);
  EXPECT_EQ(again.sensors.front().T_reference_sensor->rotation, left.T_reference_sensor->rotation);
  EXPECT_EQ(again.sensors.front().T_reference_sensor->translation,
            left.T_reference_sensor->translation);
}

TEST(CalibrateRig, ShowsThePosesAlongThePipeline) {
  const CalibratedRig rig = calibrated(street_scenes(kLeft, 2));
  EXPECT_EQ(rig.shown.scene, "0");
  ASSERT_TRUE(rig.shown.reference);
  ASSERT_EQ(rig.shown.sensors.size(), 1U);
  const ShownSensor& left = rig.shown.sensors.front();
  ASSERT_TRUE(left.cloud);
  ASSERT_GT(left.path.size(), 1U);
  expect_near(left.path.back().T_reference_sensor, kLeft);
  for (std::size_t i = 1; i < left.path.size(); ++i) {
    EXPECT_NE(left.path[i].step, left.path[i - 1].step);
    EXPECT_FALSE(left.path[i].T_reference_sensor == left.path[i - 1].T_reference_sensor);
  }
  ASSERT_TRUE(left.rival);
  EXPECT_GT(pose_error(*left.rival, kLeft).rotation_rad, rad_from_deg(5.0));
  const CalibratedRig paper = calibrated(street_scenes(kLeft, 1), 2, "paper");
  EXPECT_FALSE(paper.shown.sensors.front().rival);  // It has no global search.
}

TEST(CalibrateRig, StartsFromNothingIfANominalPoseIsWrong) {
  std::vector<Scene> scenes = street_scenes(kLeft, 1);
  scenes[0].sensors[0].nominal =
      RigidTransform{rotation_from_rpy({0.0, 0.0, -1.0}), {4.0, 0.0, 0.0}};
  const CalibratedRig rig = calibrated(scenes);
  ASSERT_TRUE(rig.sensors.front().is_accepted);
  expect_near(*rig.sensors.front().T_reference_sensor, kLeft);
  EXPECT_EQ(rig.sensors.front().nominal->translation.x(), 4.0);
}

TEST(CalibrateRig, SetsAsideASensorThatIsACopyOfAnother) {
  std::vector<Scene> scenes = street_scenes(kLeft, 1);
  SensorScan copy = scenes.front().reference;
  copy.sensor = "copy";
  scenes.front().sensors.push_back(copy);
  const CalibratedRig rig = calibrated(scenes);
  ASSERT_EQ(rig.sensors.size(), 2U);
  EXPECT_TRUE(rig.sensors[0].is_accepted);
  EXPECT_FALSE(rig.sensors[1].is_accepted);
  EXPECT_FALSE(rig.sensors[1].T_reference_sensor.has_value());
  EXPECT_EQ(rig.sensors[1].reasons,
            std::vector<std::string>{"the cloud of copy is a copy of the cloud of top"});
}

TEST(CalibrateRig, NamesWhatTookNoPart) {
  std::vector<Scene> scenes = street_scenes(kLeft, 1);
  scenes.push_back(scenes.front());
  scenes.back().name = "copy";
  scenes.push_back(scenes.front());
  scenes.back().name = "damaged";
  scenes.back().reference = damaged_scan("top");
  scenes.front().sensors.push_back(damaged_scan("right"));
  scenes.front().sensors.push_back(scan_of("front", {}));
  const CalibratedRig rig = calibrated(scenes, 2, "paper");
  ASSERT_EQ(rig.unused.size(), 4U);
  EXPECT_EQ(rig.unused[0], "Scene 0: the cloud of right: line 3: expected a number.");
  EXPECT_EQ(rig.unused[1], "Scene 0: the cloud of front: it has no points.");
  EXPECT_EQ(rig.unused[2],
            "Scene damaged: the cloud of top: line 3: expected a number; the scene is not used.");
  EXPECT_NE(rig.unused[3].find("Scene copy: its clouds are copies"), std::string::npos);
  ASSERT_EQ(rig.sensors.size(), 3U);
  EXPECT_FALSE(rig.sensors[1].is_accepted);
  EXPECT_FALSE(rig.sensors[1].T_reference_sensor);
  EXPECT_EQ(rig.sensors[1].reasons.front(), "the cloud of right: line 3: expected a number");
}

TEST(CalibrateRig, RefusesWhatCannotBeCalibrated) {
  std::vector<Scene> scenes = street_scenes(kLeft, 1);
  EXPECT_NE(input_error([&] { calibrated(scenes, 1, "bst"); }).find("did you mean \"best\"?"),
            std::string::npos);
  scenes.front().sensors = {damaged_scan("left")};
  EXPECT_NE(input_error([&] { calibrated(scenes); }).find("line 3: expected a number"),
            std::string::npos);
  EXPECT_NE(input_error([] { calibrated({}); }).find("at least one scene"), std::string::npos);
}

TEST(Composition, AlwaysEndsWithAVerdictAndACovariance) {
  const TempFolder folder;
  const std::string file = folder.write("p.json", R"([{"step": "registration"}])").string();
  const Composition composition = composition_called(file, {0.5, 1.0}, registry());
  ASSERT_EQ(composition.from_nothing.size(), 3U);
  EXPECT_EQ(composition.from_nothing[1].name, "verdict");
  EXPECT_EQ(composition.from_nothing[2].name, "covariance");
  EXPECT_EQ(composition.near_nominal.size(), 3U);
  for (const std::string& name : recommended_pipeline_names()) {
    EXPECT_EQ(composition_called(name, {0.5, 1.0}, registry()).name, name);
  }
}

TEST(CalibrateRig, NotesFormerNamesOfKeys) {
  const TempFolder folder;
  const std::string file = folder.write("p.json", R"([{"step": "verdict", "slides": 1}])").string();
  const CalibratedRig rig = calibrated(street_scenes(kLeft, 1), 1, file);
  ASSERT_EQ(rig.notes.size(), 1U);
  EXPECT_EQ(rig.notes[0].line(),
            file + ": /0/slides: the key \"slides\" is now called \"split_directions\"");
}

TEST(ReasonsInWords, AreSentencesWithNumbersAndAdvice) {
  const ReasonsInWords words = reasons_in_words(
      "verdict: the overlap with agreeing surfaces is 0.123, below 0.150; not constrained: x and "
      "yaw (strength 0.0012, below 0.0100); a reason of another stage",
      std::nullopt);
  ASSERT_EQ(words.reasons.size(), 3U);
  EXPECT_EQ(
      words.reasons[0],
      "Only 12.3 % of the points that both sensors should see agree; at least 15.0 % is required.");
  EXPECT_EQ(words.reasons[1], "The surfaces that both sensors see do not constrain x and yaw.");
  EXPECT_EQ(words.reasons[2], "A reason of another stage.");
  EXPECT_EQ(words.advice.size(), 3U);
}

TEST(ReasonsInWords, NameTheRival) {
  const ReasonsInWords words = reasons_in_words(
      "verdict: the lead over a pose 3.0 m further along -x, in standard deviations, is -0.125, "
      "below 4.000",
      std::nullopt);
  ASSERT_EQ(words.reasons.size(), 1U);
  EXPECT_EQ(words.reasons[0],
            "A pose 3.0 m further along -x explains the clouds nearly as well: the lead over it is "
            "-0.125 standard deviations; at least 4 are required.");
  EXPECT_EQ(words.advice.size(), 1U);
}

}  // namespace
}  // namespace croon::test

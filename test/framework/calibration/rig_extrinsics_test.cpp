#include "framework/calibration/rig_extrinsics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "test/support/random_geometry.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::test {
namespace {

CalibratedRig random_rig(Rng& rng) {
  CalibratedRig rig;
  rig.reference = "/top/points";
  rig.composition = "best";
  rig.warnings = {"one scene alone"};
  for (const char* name : {"left", "right", "lost"}) {
    CalibratedSensor sensor;
    sensor.sensor = name;
    sensor.is_accepted = sensor.sensor == "left";
    if (sensor.sensor != "lost") {
      sensor.T_reference_sensor = random_pose(rng, 3.0);
      sensor.covariance = random_covariance(rng);
      sensor.nominal = pose_near(rng, *sensor.T_reference_sensor, 1.0, 0.1);
      sensor.scenes = {{"0", sensor.T_reference_sensor, sensor.covariance, ""}};
    }
    if (!sensor.is_accepted) sensor.reasons = {"yaw is unobservable"};
    rig.sensors.push_back(sensor);
  }
  rig.ground = GroundPose{0.01, 0.02, 1.9, 0.001, 0.001, 0.01};
  rig.heading = HeadingOfTravel{0.1, 0.01, 2};
  rig.motion = {{"0", {}, Matrix6d::Identity()}};
  return rig;
}

TEST(CalibratedRig, IsReadBackFromExtrinsicsJson) {
  Rng rng = test_rng();
  const CalibratedRig rig = random_rig(rng);
  const TempFolder folder;
  const Extrinsics read = read_extrinsics(folder.write("e.json", rig_extrinsics_json(rig)));
  EXPECT_EQ(read.parent, rig.reference);
  ASSERT_EQ(read.poses.size(), 2U);
  for (const std::size_t i : {0, 1}) {
    const CalibratedSensor& sensor = rig.sensors[i];
    EXPECT_EQ(read.poses[i].sensor, sensor.sensor);
    EXPECT_EQ(read.poses[i].is_accepted, sensor.is_accepted);
    EXPECT_LT((read.poses[i].T_parent_sensor.rotation - sensor.T_reference_sensor->rotation).norm(),
              1e-12);
    EXPECT_EQ(read.poses[i].T_parent_sensor.translation, sensor.T_reference_sensor->translation);
    ASSERT_TRUE(read.poses[i].covariance);
    EXPECT_EQ(read.poses[i].covariance->matrix, sensor.covariance->matrix);
    EXPECT_EQ(read.poses[i].covariance->dofs, sensor.covariance->dofs);
  }
}

TEST(CalibratedRig, SeparatesItsErrorBudgetInJson) {
  Rng rng = test_rng();
  CalibratedRig rig = random_rig(rng);
  CalibratedSensor& left = rig.sensors[0];
  left.covariance->matrix = 5e-4 * Matrix6d::Identity();
  left.error_budget = 4e-4 * Matrix6d::Identity();
  const auto json = nlohmann::json::parse(rig_extrinsics_json(rig)).at("sensors").at(0);
  const auto& budget = json.at("error_budget");
  EXPECT_EQ(budget.at("covariance").at(3).at(3), 4e-4);
  EXPECT_NEAR(budget.at("standard_deviation").at("translation_m").at(0), 0.02, 1e-12);
  EXPECT_NEAR(budget.at("statistical_standard_deviation").at("translation_m").at(0), 0.01, 1e-12);
  EXPECT_NEAR(json.at("standard_deviation").at("translation_m").at(0), std::sqrt(5e-4), 1e-12);
}

TEST(CalibratedRig, SaysInJsonWhatIsMissing) {
  Rng rng = test_rng();
  const auto json = nlohmann::json::parse(rig_extrinsics_json(random_rig(rng)));
  EXPECT_TRUE(json["sensors"][2]["T_reference_sensor"].is_null());
  EXPECT_TRUE(json["sensors"][2]["standard_deviation"].is_null());
  EXPECT_TRUE(json["sensors"][2]["error_budget"].is_null());
  EXPECT_TRUE(json["sensors"][2]["from_nominal"].is_null());
  EXPECT_TRUE(json["sensors"][2]["fit"].is_null());
  EXPECT_EQ(json["sensors"][1]["verdict"], "rejected");
  EXPECT_EQ(json["sensors"][1]["reasons"][0], "yaw is unobservable");
  EXPECT_LT(json["sensors"][0]["from_nominal"]["rotation_deg"], 2.0);
  EXPECT_NEAR(json["ground"]["height_m"], 1.9, 1e-12);
}

TEST(CalibratedRig, HasAllItsSensorsInExtrinsics) {
  Rng rng = test_rng();
  const Extrinsics extrinsics = extrinsics_of(random_rig(rng));
  ASSERT_EQ(extrinsics.poses.size(), 3U);
  EXPECT_FALSE(extrinsics.poses[2].has_pose);
  const std::string csv = write_extrinsics(extrinsics, "csv", false).front().text;
  EXPECT_NE(csv.find("\nlost,rejected,,,,,,,\n"), std::string::npos) << csv;
}

}  // namespace
}  // namespace croon::test

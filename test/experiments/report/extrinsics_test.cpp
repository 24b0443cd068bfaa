#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/report/result_tables.hpp"
#include "framework/base/angles.hpp"
#include "test/experiments/support/summary_text.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::random_pose;
using croon::test::test_rng;
using test::kBounds;

/// Trials without truth: in scenes "a" and "b" all 10 end at `pose`, in "c" 9 of 10 end elsewhere
/// apart from each other.
std::vector<TrialRecord> records_at(const RigidTransform& pose) {
  Rng rng = test_rng(3);
  std::vector<TrialRecord> records;
  for (const char* scene : {"a", "b", "c"}) {
    for (int trial = 0; trial < 10; ++trial) {
      const bool is_astray = *scene == 'c' && trial > 0;
      records.push_back(test::finished_without_truth({"base", scene, "left", trial},
                                                     is_astray ? random_pose(rng, 9.0) : pose));
    }
  }
  records.push_back(test::unfinished({"base", "c", "left", 10}, Status::failed, "no ground"));
  return records;
}

TEST(Extrinsics, AreThePoseThatMostTrialsAgreeOn) {
  Rng rng = test_rng();
  const RigidTransform pose = random_pose(rng, 3.0);
  const auto parsed = nlohmann::json::parse(
      extrinsics_json(summarise(records_at(pose), kBounds, {}), {{"left", "top"}}));
  ASSERT_EQ(parsed["extrinsics"].size(), 1U);
  const auto& found = parsed["extrinsics"][0];
  EXPECT_EQ(found["reference_sensor"], "top");
  EXPECT_EQ(found["trials"], 31);
  EXPECT_EQ(found["agreeing"], 21);
  EXPECT_NEAR(found["spread"]["rotation_deg"], 0.0, 1e-6);
  const auto& T = found["T_reference_sensor"];
  const Eigen::Vector4d q = unit_quaternion(pose.rotation).coeffs();
  const Eigen::Vector3d rpy_rad = rpy_from_rotation(pose.rotation);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(T["translation_m"][i], pose.translation(i), 1e-9);
    EXPECT_NEAR(T["matrix"][i][3], pose.translation(i), 1e-9);
    EXPECT_NEAR(T["roll_pitch_yaw_deg"][i], deg_from_rad(rpy_rad(i)), 1e-9);
    EXPECT_EQ(T["matrix"][3][i], 0.0);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(T["matrix"][i][j], pose.rotation(i, j), 1e-9);
  }
  EXPECT_EQ(T["matrix"][3][3], 1.0);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(T["quaternion_xyzw"][i], q(i), 1e-9);
  ASSERT_EQ(found["scenes"].size(), 3U);
  EXPECT_EQ(found["scenes"][0]["agreeing"], 10);
  EXPECT_EQ(found["scenes"][2]["scene"], "c");
  EXPECT_EQ(found["scenes"][2]["trials"], 11);
  EXPECT_EQ(found["scenes"][2]["agreeing"], 0);  // No two of them agree.
  EXPECT_TRUE(found["scenes"][2]["T_reference_sensor"].is_null());
}

TEST(Extrinsics, OnWhichNoTwoTrialsAgreeAreNothing) {
  Rng rng = test_rng(5);
  std::vector<TrialRecord> records;
  for (const char* scene : {"a", "b"}) {
    for (int trial = 0; trial < 2; ++trial) {
      records.push_back(
          test::finished_without_truth({"base", scene, "left", trial}, random_pose(rng, 9.0)));
    }
  }
  const Summary summary = summarise(records, kBounds, {});
  const auto found = nlohmann::json::parse(extrinsics_json(summary, {}))["extrinsics"][0];
  EXPECT_TRUE(found["T_reference_sensor"].is_null());
  EXPECT_EQ(found["agreeing"], 0);
  const std::string text = test::summary_text(summary);
  EXPECT_NE(text.find("No pose: no two trials agree.\n"), std::string::npos) << text;
}

TEST(Extrinsics, DoNotComeFromScenesThatAreAlikeByChance) {
  Rng rng = test_rng(6);
  const RigidTransform pose = random_pose(rng, 9.0);
  std::vector<TrialRecord> records;
  const auto add = [&](const char* scene, int trial, const RigidTransform& of) {
    records.push_back(test::finished_without_truth({"base", scene, "left", trial}, of));
  };
  // No two trials of a scene agree, but one of `a` does with one of `b`.
  for (const char* scene : {"a", "b"}) {
    add(scene, 0, pose);
    add(scene, 1, random_pose(rng, 9.0));
  }
  const auto found = [&] {
    return nlohmann::json::parse(
        extrinsics_json(summarise(records, kBounds, {}), {}))["extrinsics"][0];
  };
  EXPECT_EQ(found()["agreeing"], 0);
  EXPECT_TRUE(found()["T_reference_sensor"].is_null());
  // Two scenes of one trial each do agree.
  records.clear();
  add("a", 0, pose);
  add("b", 0, pose);
  add("c", 0, random_pose(rng, 9.0));
  EXPECT_EQ(found()["agreeing"], 2);
  // One alone does not.
  records.clear();
  add("a", 0, pose);
  add("b", 0, random_pose(rng, 9.0));
  add("b", 1, random_pose(rng, 9.0));
  EXPECT_EQ(found()["agreeing"], 0);
}

TEST(Extrinsics, HaveACovarianceIfAllThatAgreeHaveOne) {
  Rng rng = test_rng(4);
  std::vector<TrialRecord> records = records_at(random_pose(rng, 3.0));
  const auto parsed = [&] {
    return nlohmann::json::parse(extrinsics_json(summarise(records, kBounds, {}), {}));
  };
  EXPECT_FALSE(parsed()["extrinsics"][0].contains("covariance"));
  PoseCovariance covariance = croon::test::random_covariance(rng);
  covariance.dofs.fill(Observability::determined);
  covariance.dofs[2] = Observability::weak;
  for (TrialRecord& record : records) record.covariance = covariance;
  const auto found = parsed()["extrinsics"][0];
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) {
      const auto at = [&](const nlohmann::json& of) {
        return of["covariance"]["roll_pitch_yaw_rad_x_y_z_m"][i][j].get<double>();
      };
      // Trials of one scene share their data, scenes do not; two scenes agree.
      EXPECT_NEAR(at(found["scenes"][0]), covariance.matrix(i, j), 1e-12);
      EXPECT_NEAR(at(found), covariance.matrix(i, j) / 2.0, 1e-12);
    }
  }
  EXPECT_EQ(found["covariance"]["yaw"], "weak");
  EXPECT_EQ(found["covariance"]["x"], "determined");
  records.front().covariance.reset();
  EXPECT_TRUE(parsed()["extrinsics"][0]["covariance"].is_null());
  EXPECT_FALSE(parsed()["extrinsics"][0]["scenes"][1]["covariance"].is_null());
}

TEST(Extrinsics, AreTheSameBytesInAnyOrder) {
  Rng rng = test_rng();
  const auto records = records_at(random_pose(rng, 3.0));
  const auto bytes = [](const std::vector<TrialRecord>& of) {
    return extrinsics_json(summarise(of, kBounds, {}), {});
  };
  EXPECT_EQ(bytes(records), bytes(test::shuffled(rng, records)));
}

TEST(Extrinsics, WithoutAPoseAreNothing) {
  const auto parsed = nlohmann::json::parse(extrinsics_json(
      summarise({test::unfinished({"base", "a", "left", 0}, Status::failed, "no")}, kBounds, {}),
      {}));
  EXPECT_TRUE(parsed["extrinsics"][0]["T_reference_sensor"].is_null());
  EXPECT_TRUE(parsed["extrinsics"][0]["spread"].is_null());
  EXPECT_EQ(parsed["extrinsics"][0]["agreeing"], 0);
}

TEST(Extrinsics, WithTruthDoNotUseIt) {
  // Most trials agree on a pose that is wrong.
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 5; ++trial) {
    const bool is_right = trial < 2;
    records.push_back(test::finished({"base", "a", "left", trial},
                                     is_right ? Status::success : Status::inaccurate, {},
                                     test::offset_of(0, 0, 0, is_right ? 0.0 : 1.0, 0, 0)));
  }
  const auto parsed = nlohmann::json::parse(extrinsics_json(summarise(records, kBounds, {}), {}));
  EXPECT_EQ(parsed["extrinsics"][0]["T_reference_sensor"]["translation_m"][0], 1.0);
  EXPECT_EQ(parsed["extrinsics"][0]["agreeing"], 3);
}

TEST(Extrinsics, AreATableIfThereIsNoTruth) {
  const RigidTransform pose = {rotation_from_rpy({rad_from_deg(1.0), 0.0, rad_from_deg(90.0)}),
                               {1.5, -0.25, 0.125}};
  const std::string text = test::summary_text(summarise(records_at(pose), kBounds, {}));
  EXPECT_NE(text.find("\nleft    1.5000  -0.2500  0.1250     1.000      0.000   90.000     21/31  "
                      "0.000, 0.0000\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(test::summary_text(summarise(test::few_records(), kBounds, {})).find("extrinsics"),
            std::string::npos);
}

}  // namespace
}  // namespace croon::experiments

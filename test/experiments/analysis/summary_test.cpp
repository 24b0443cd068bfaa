#include "experiments/analysis/summary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/report/result_tables.hpp"
#include "framework/base/angles.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::random_pose;
using croon::test::test_rng;
using test::kBounds;

double in_report_unit(const Vector6d& offset, std::size_t dof) {
  const double value = offset(static_cast<Eigen::Index>(dof));
  return dof < 3 ? deg_from_rad(value) : value;
}

/// `trials` per scene at the sensor's pose moved by the scene's bias, half of them by +`spread`,
/// half by
/// -`spread`.
std::vector<TrialRecord> biased_records(const RigidTransform& pose,
                                        const std::vector<Vector6d>& biases, const Vector6d& spread,
                                        int trials, bool has_truth) {
  std::vector<TrialRecord> records;
  for (std::size_t scene = 0; scene < biases.size(); ++scene) {
    for (int trial = 0; trial < trials; ++trial) {
      const TrialId id = {"base", std::to_string(scene), "front", trial};
      const Vector6d offset = biases[scene] + (trial % 2 == 0 ? spread : Vector6d(-spread));
      records.push_back(has_truth ? test::finished(id, Status::success, pose, offset)
                                  : test::finished_without_truth(id, moved(pose, offset)));
    }
  }
  return records;
}

/// Rotations about one axis, so that they add up exactly.
Vector6d yaw_and_shift(double yaw_deg, double x_m) {
  return test::offset_of(0.0, 0.0, yaw_deg, x_m, -x_m, 0.5 * x_m);
}

TEST(Summary, FindsTheBiasAndTheSpreadThatWerePutIn) {
  Rng rng = test_rng();
  for (int i = 0; i < 20; ++i) {
    const RigidTransform truth = random_pose(rng, 3.0);
    const Vector6d bias = test::random_offset(rng, 0.1, 0.03);
    const Vector6d spread = test::random_offset(rng, 0.1, 0.03);
    const int trials = 10;
    const Summary summary =
        summarise(biased_records(truth, {bias}, spread, trials, true), kBounds, {});
    ASSERT_EQ(summary.rows.size(), 1U);
    const SummaryRow& row = summary.rows[0];
    EXPECT_EQ(row.deviations_from, DeviationsFrom::truth);
    EXPECT_EQ(row.counted, trials);
    for (std::size_t k = 0; k < kDofs; ++k) {
      const Statistics& statistics = (*row.statistics)[k];
      const double mean = in_report_unit(bias, k);
      const double half = std::abs(in_report_unit(spread, k));
      EXPECT_NEAR(statistics[statistic_index("mean")], mean, 1e-9);
      EXPECT_NEAR(statistics[statistic_index("median")], mean, 1e-9);
      EXPECT_NEAR(statistics[statistic_index("std")], half * std::sqrt(trials / (trials - 1.0)),
                  1e-9);
      EXPECT_NEAR(statistics[statistic_index("rmse")], std::hypot(mean, half), 1e-9);
      EXPECT_NEAR(statistics[statistic_index("p95")], std::abs(mean) + half, 1e-9);
    }
  }
}

TEST(Summary, WhereSomeHaveTruthTheOthersAreNotJudged) {
  Rng rng = test_rng();
  const RigidTransform pose = random_pose(rng, 3.0);
  std::vector<TrialRecord> records;
  for (int scene = 0; scene < 8; ++scene) {
    const std::string name = std::to_string(scene);
    const TrialId left = {"base", name, "left", 0};
    // Truth of left in half of the scenes, of right in none.
    const Vector6d offset = test::random_offset(rng, 0.1, 0.02);
    records.push_back(scene < 4 ? test::finished(left, Status::success, pose, offset)
                                : test::finished_without_truth(left, pose));
    records.push_back(test::finished_without_truth({"base", name, "right", 0}, pose));
  }
  records.push_back(test::unfinished({"base", "0", "right", 1}, Status::failed, "no ground"));
  ReportOrder order;
  order.without_truth = {"right"};
  const Summary summary = summarise(records, kBounds, order);
  const TrialSummary all = pooled(scenes_of(rows_of(summary, "base")));
  for (const TrialSummary& judged : {TrialSummary(summary.rows[0]), all}) {
    EXPECT_EQ(judged.deviations_from, DeviationsFrom::truth);
    EXPECT_EQ(judged.success.count, 4);
    EXPECT_EQ(judged.success.trials, 4);
    EXPECT_EQ(judged.counted, 4);
    EXPECT_EQ(judged.usable, 4);
  }
  EXPECT_EQ(all.outcomes.trials, 17);
  EXPECT_TRUE(lacks_truth(summary.rows[1]));
  EXPECT_EQ(summary.curve.rows.back().shares[12].trials, 4);
  EXPECT_EQ(summary.curve.rows.back().shares[12].count, 4);
}

TEST(Summary, DoesNotDependOnTheOrderOfTheRecords) {
  Rng rng = test_rng();
  const auto records = test::few_records();
  const std::string csv = summary_csv(summarise(records, kBounds, {}));
  const std::string json = summary_json(summarise(records, kBounds, {}));
  for (int i = 0; i < 20; ++i) {
    const Summary summary = summarise(test::shuffled(rng, records), kBounds, {});
    EXPECT_EQ(summary_csv(summary), csv);
    EXPECT_EQ(summary_json(summary), json);
    // Yaw grows from trial to trial.
    const std::vector<Measures>& deviations = summary.rows[0].scenes[0].deviations;
    ASSERT_EQ(deviations.size(), 3U);
    EXPECT_LT(deviations[0][2], deviations[1][2]);
    EXPECT_LT(deviations[1][2], deviations[2][2]);
  }
}

TEST(Summary, KeepsTheGivenOrderAndPutsOthersLast) {
  const Summary summary = summarise(test::few_records(), kBounds,
                                    {{"no volume"}, {"right", "none"}, {"0002", "0001"}, {}});
  ASSERT_EQ(summary.rows.size(), 4U);
  EXPECT_EQ(summary.rows[0].variant + "/" + summary.rows[0].sensor, "no volume/right");
  EXPECT_EQ(summary.rows[1].variant + "/" + summary.rows[1].sensor, "no volume/left");
  EXPECT_EQ(summary.rows[2].variant + "/" + summary.rows[2].sensor, "base/right");
  EXPECT_EQ(summary.rows[0].scenes[0].scene, "0002");
  EXPECT_EQ(summary.rows[0].scenes[1].scene, "0001");
}

TEST(Summary, CountsOutcomesAndReasons) {
  const Summary summary = summarise(test::few_records(), kBounds, {});
  const SummaryRow& left = summary.rows[0];
  EXPECT_EQ(left.outcomes.trials, 8);
  EXPECT_EQ(left.outcomes.success, 6);
  EXPECT_EQ(left.outcomes.inaccurate, 1);
  EXPECT_EQ(left.outcomes.failed, 1);
  EXPECT_EQ(left.counted, 6);
  EXPECT_DOUBLE_EQ(left.success.ratio, 0.75);
  EXPECT_EQ(summary.rows[1].outcomes.rejected, 1);
  ASSERT_EQ(left.scenes.size(), 2U);
  EXPECT_EQ(left.scenes[0].outcomes.inaccurate, 1);
  EXPECT_EQ(left.scenes[1].outcomes.failed, 1);
  ASSERT_EQ(summary.reasons.size(), 3U);
  EXPECT_EQ(summary.reasons[0].count, 1);
}

TEST(Summary, StatisticsOverUsableTrialsHaveThoseThatFail) {
  // Errors of 0, 1, ... 9 cm succeed, one of 3 m does not; another is rejected.
  std::vector<TrialRecord> records;
  std::vector<double> all_m;
  for (int trial = 0; trial < 11; ++trial) {
    all_m.push_back(trial == 10 ? 3.0 : 0.01 * trial);
    records.push_back(test::finished({"base", "s", "front", trial},
                                     trial == 10 ? Status::inaccurate : Status::success, {},
                                     test::offset_of(0, 0, 0, all_m.back(), 0, 0)));
  }
  records.push_back(test::finished({"base", "s", "front", 11}, Status::rejected, {},
                                   test::offset_of(0, 0, 0, 9.0, 0, 0)));
  const SummaryRow row = summarise(records, kBounds, {}).rows.at(0);
  EXPECT_EQ(row.counted, 10);
  EXPECT_EQ(row.usable, 11);
  const std::size_t std = statistic_index("std");
  EXPECT_LT((*row.statistics)[3][std], 0.04);
  EXPECT_NEAR((*row.usable_statistics)[3][std], standard_deviation(all_m), 1e-12);
}

TEST(Summary, AFrameSucceedsIfEveryTrialOfEachSensorDoes) {
  std::vector<TrialRecord> records;
  for (const char* scene : {"0", "1", "2"}) {
    for (const char* sensor : {"front", "left"}) {
      for (int trial = 0; trial < 2; ++trial) {
        const bool fails = scene == std::string("1") && sensor == std::string("left") && trial == 1;
        records.push_back(test::finished({"base", scene, sensor, trial},
                                         fails ? Status::inaccurate : Status::success, {},
                                         yaw_and_shift(fails ? 5.0 : 0.1, 0.0)));
      }
    }
  }
  const Summary summary = summarise(records, kBounds, {});
  ASSERT_EQ(summary.frames.size(), 1U);
  EXPECT_EQ(summary.frames[0].frames.count, 2);
  EXPECT_EQ(summary.frames[0].frames.trials, 3);
  EXPECT_FALSE(summary.frames[0].frames.interval);
  const auto json = nlohmann::json::parse(summary_json(summary, {}));
  EXPECT_EQ(json["frames"][0]["success"]["count"], 2);
  for (TrialRecord& record : records) record.error.reset();
  EXPECT_TRUE(summarise(records, kBounds, {}).frames.empty());
}

TEST(Summary, NoTrialAgreesWithItselfAlone) {
  Rng rng = test_rng();
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 6; ++trial) {
    records.push_back(
        test::finished_without_truth({"base", "0", "front", trial}, random_pose(rng, 30.0)));
  }
  const auto agreement = [&] { return summarise(records, kBounds, {}).rows[0].agreement; };
  EXPECT_EQ(agreement().count, 0);
  EXPECT_EQ(agreement().trials, 6);
  records.resize(1);
  EXPECT_EQ(agreement().trials, 0);  // There is none to agree with.
  const Summary alone = summarise(records, kBounds, {});
  EXPECT_FALSE(agrees(records[0], alone.rows[0].scenes[0], {0.01, 0.1}));
  EXPECT_EQ(alone.rows[0].counted, 1);
  const auto json = nlohmann::json::parse(summary_json(alone, {}));
  EXPECT_TRUE(json["rows"][0]["agreement"].is_null());
}

TEST(Summary, TheMostFrequentReasonComesFirst) {
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 5; ++trial) {
    records.push_back(test::unfinished({"base", "s", "front", trial}, Status::failed,
                                       trial % 2 == 0 ? "often" : "a seldom one"));
  }
  const Summary summary = summarise(records, kBounds, {});
  ASSERT_EQ(summary.reasons.size(), 2U);
  EXPECT_EQ(summary.reasons[0].reason, "often");
  EXPECT_EQ(summary.reasons[0].count, 3);
  EXPECT_EQ(summary.rows[0].deviations_from, DeviationsFrom::none);
  EXPECT_FALSE(summary.rows[0].statistics);
  EXPECT_FALSE(summary.rows[0].consensus);
}

TEST(Summary, SplitsTheSpreadIntoWithinAndAcrossScenes) {
  Rng rng = test_rng();
  const std::vector<Vector6d> biases = {yaw_and_shift(-0.1, -0.02), yaw_and_shift(0.0, 0.0),
                                        yaw_and_shift(0.1, 0.02)};
  const Vector6d spread = yaw_and_shift(0.05, 0.01);
  const int trials = 8;
  for (const bool has_truth : {true, false}) {
    const auto records = biased_records(random_pose(rng, 3.0), biases, spread, trials, has_truth);
    const SummaryRow row = summarise(records, kBounds, {}).rows.at(0);
    EXPECT_EQ(row.deviations_from, has_truth ? DeviationsFrom::truth : DeviationsFrom::consensus);
    ASSERT_TRUE(row.within_scene_std && row.across_scenes_std);
    const double yaw_within_deg = 0.05 * std::sqrt(trials / (trials - 1.0));
    EXPECT_NEAR((*row.within_scene_std)[2], yaw_within_deg, 1e-9);
    EXPECT_NEAR((*row.across_scenes_std)[2], 0.1, 1e-9);
    EXPECT_NEAR((*row.within_scene_std)[3], yaw_within_deg / 5.0, 1e-9);
    EXPECT_NEAR((*row.across_scenes_std)[3], 0.02, 1e-9);
    EXPECT_NEAR((*row.within_scene_std)[0], 0.0, 1e-9);
    EXPECT_NEAR((*row.scenes[2].statistics)[2][statistic_index("mean")], 0.1, 1e-9);
  }
}

TEST(Summary, OneSceneHasNoSpreadAcrossAndOneTrialNoneWithin) {
  Rng rng = test_rng();
  const auto records =
      biased_records(random_pose(rng, 1.0), {yaw_and_shift(0.1, 0.01)}, Vector6d::Zero(), 1, true);
  const SummaryRow row = summarise(records, kBounds, {}).rows.at(0);
  EXPECT_FALSE(row.within_scene_std);
  EXPECT_FALSE(row.across_scenes_std);
}

TEST(Summary, WithoutTruthTrialsThatGoAstrayDoNotCount) {
  Rng rng = test_rng();
  const RigidTransform pose = random_pose(rng, 3.0);
  const Vector6d spread = yaw_and_shift(0.05, 0.01);
  auto records = biased_records(pose, {Vector6d::Zero(), Vector6d::Zero()}, spread, 10, false);
  const SummaryRow before = summarise(records, kBounds, {}).rows.at(0);
  for (int trial = 10; trial < 15; ++trial) {
    records.push_back(
        test::finished_without_truth({"base", "0", "front", trial}, random_pose(rng, 3.0)));
  }
  const SummaryRow after = summarise(records, kBounds, {}).rows.at(0);
  EXPECT_EQ(before.agreement.count, 20);
  EXPECT_EQ(after.agreement.count, 20);
  EXPECT_EQ(after.agreement.trials, 25);
  EXPECT_EQ(after.success.count, 0);
  EXPECT_EQ(after.outcomes.finished, 25);
  EXPECT_EQ(after.counted, 20);
  EXPECT_LT(pose_error(*after.consensus, pose).rotation_rad, 1e-9);
  for (std::size_t k = 0; k < kDofs; ++k) {
    EXPECT_NEAR((*after.statistics)[k][statistic_index("std")],
                (*before.statistics)[k][statistic_index("std")], 1e-9);
  }
}

TEST(Summary, ASceneThatAgreesOnTheWrongPoseShowsAcrossScenesOnly) {
  Rng rng = test_rng();
  const std::vector<Vector6d> biases = {yaw_and_shift(0, 0), yaw_and_shift(0, 0),
                                        yaw_and_shift(180.0, 0.0)};
  const auto records =
      biased_records(random_pose(rng, 3.0), biases, yaw_and_shift(0.05, 0.01), 10, false);
  const SummaryRow row = summarise(records, kBounds, {}).rows.at(0);
  EXPECT_NEAR((*row.within_scene_std)[2], 0.05 * std::sqrt(10.0 / 9.0), 1e-6);
  EXPECT_GT((*row.across_scenes_std)[2], 90.0);
}

TEST(SummaryJson, SaysWhatTheSummarySays) {
  const Summary summary = summarise(test::few_records(), kBounds, {});
  const auto json = nlohmann::json::parse(summary_json(summary));
  EXPECT_EQ(json["success_bounds"]["rotation_deg"], 0.5);
  ASSERT_EQ(json["rows"].size(), summary.rows.size());
  const auto& row = json["rows"][0];
  EXPECT_EQ(row["variant"], "base");
  EXPECT_EQ(row["success"]["count"], 6);
  EXPECT_EQ(row["statistics"]["pitch_deg"]["mean"],
            (*summary.rows[0].statistics)[1][statistic_index("mean")]);
  EXPECT_EQ(row["across_scenes_std"]["roll_deg"], (*summary.rows[0].across_scenes_std)[0]);
  EXPECT_EQ(row["scenes"][1]["scene"], "0002");
  EXPECT_EQ(row["scenes"][1]["counted"], 3);
  EXPECT_EQ(row["scenes"][1]["consensus"]["rotation_xyzw"].size(), 4U);
  EXPECT_EQ(json["reasons"][0]["status"], "rejected");
  EXPECT_EQ(json["reasons"][1]["status"], "failed");
}

TEST(SummaryJson, DoesNotListThousandsOfScenes) {
  std::vector<TrialRecord> records;
  for (std::size_t scene = 0; scene <= kMaxJsonScenes; ++scene) {
    for (const char* sensor : {"left", "right"}) {
      if (scene == 0 && std::string(sensor) == "right") continue;
      records.push_back(test::finished({"base", std::to_string(scene), sensor, 0}, Status::success,
                                       {}, Vector6d::Zero()));
    }
  }
  const auto json = nlohmann::json::parse(summary_json(summarise(records, kBounds, {})));
  EXPECT_TRUE(json["rows"][0]["scenes"].is_null());
  EXPECT_EQ(json["rows"][1]["scenes"].size(), kMaxJsonScenes);
  EXPECT_EQ(json["rows"][0]["trials"], kMaxJsonScenes + 1);
}

TEST(SummaryJson, TakesNamesThatAreNoUtf8) {
  const Summary summary = summarise(
      {test::unfinished({"base", "\xff", "front", 0}, Status::failed, "\xc3")}, kBounds, {});
  EXPECT_TRUE(nlohmann::json::accept(summary_json(summary)));
}

std::vector<std::string> split(const std::string& text, char by) {
  std::vector<std::string> parts(1);
  for (const char c : text) c == by ? parts.emplace_back() : parts.back() += std::string(1, c);
  return parts;
}

TEST(SummaryCsv, EveryRowHasEveryColumn) {
  auto records = test::few_records();
  records.push_back(test::unfinished({"base", "0003", "rear", 0}, Status::failed, "no ground"));
  const Summary summary = summarise(records, kBounds, {});
  const std::vector<std::string> lines = split(summary_csv(summary), '\n');
  ASSERT_EQ(lines.size(), summary.rows.size() + 2);
  const std::vector<std::string> header = split(lines[0], ',');
  EXPECT_EQ(header.size(), 17U + 8U * 5U + 2U * 6U + 1U + 8U * 5U);
  for (std::size_t i = 0; i < summary.rows.size(); ++i) {
    const std::vector<std::string> cells = split(lines[i + 1], ',');
    ASSERT_EQ(cells.size(), header.size());
    for (std::size_t k = 0; k < header.size(); ++k) {
      if (header[k] == "trials") {
        EXPECT_EQ(cells[k], std::to_string(summary.rows[i].outcomes.trials));
      }
      if (header[k] == "yaw_rmse_deg") {
        EXPECT_EQ(cells[k].empty(), !summary.rows[i].statistics);
      }
    }
  }
}

TEST(SummaryCsv, HeaderIsStable) {
  EXPECT_EQ(
      summary_csv(Summary{}),
      "variant,sensor,reference,trials,success,inaccurate,finished,rejected,failed,success_ratio,"
      "success_low_ratio,success_high_ratio,agreement,agreement_ratio,agreement_low_ratio,"
      "agreement_high_ratio,counted,"
      "roll_mean_deg,roll_std_deg,roll_median_deg,roll_rmse_deg,roll_p95_deg,"
      "pitch_mean_deg,pitch_std_deg,pitch_median_deg,pitch_rmse_deg,pitch_p95_deg,"
      "yaw_mean_deg,yaw_std_deg,yaw_median_deg,yaw_rmse_deg,yaw_p95_deg,"
      "x_mean_m,x_std_m,x_median_m,x_rmse_m,x_p95_m,"
      "y_mean_m,y_std_m,y_median_m,y_rmse_m,y_p95_m,"
      "z_mean_m,z_std_m,z_median_m,z_rmse_m,z_p95_m,"
      "rotation_mean_deg,rotation_std_deg,rotation_median_deg,rotation_rmse_deg,rotation_p95_deg,"
      "translation_mean_m,translation_std_m,translation_median_m,translation_rmse_m,"
      "translation_p95_m,"
      "roll_within_scene_std_deg,pitch_within_scene_std_deg,yaw_within_scene_std_deg,"
      "x_within_scene_std_m,y_within_scene_std_m,z_within_scene_std_m,"
      "roll_across_scenes_std_deg,pitch_across_scenes_std_deg,yaw_across_scenes_std_deg,"
      "x_across_scenes_std_m,y_across_scenes_std_m,z_across_scenes_std_m,usable,"
      "usable_roll_mean_deg,usable_roll_std_deg,usable_roll_median_deg,usable_roll_rmse_deg,"
      "usable_roll_p95_deg,usable_pitch_mean_deg,usable_pitch_std_deg,usable_pitch_median_deg,"
      "usable_pitch_rmse_deg,usable_pitch_p95_deg,usable_yaw_mean_deg,usable_yaw_std_deg,"
      "usable_yaw_median_deg,usable_yaw_rmse_deg,usable_yaw_p95_deg,usable_x_mean_m,"
      "usable_x_std_m,usable_x_median_m,usable_x_rmse_m,usable_x_p95_m,usable_y_mean_m,"
      "usable_y_std_m,usable_y_median_m,usable_y_rmse_m,usable_y_p95_m,usable_z_mean_m,"
      "usable_z_std_m,usable_z_median_m,usable_z_rmse_m,usable_z_p95_m,"
      "usable_rotation_mean_deg,usable_rotation_std_deg,usable_rotation_median_deg,"
      "usable_rotation_rmse_deg,usable_rotation_p95_deg,usable_translation_mean_m,"
      "usable_translation_std_m,usable_translation_median_m,usable_translation_rmse_m,"
      "usable_translation_p95_m\n");
}

}  // namespace
}  // namespace croon::experiments

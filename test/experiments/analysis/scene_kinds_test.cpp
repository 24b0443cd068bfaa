#include "experiments/analysis/summary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/report/result_tables.hpp"
#include "framework/table/renderers.hpp"
#include "test/experiments/support/summary_text.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::test_rng;
using test::kBounds;

/// The sample records with a kind for each of their scenes.
Summary two_kinds() {
  ReportOrder order;
  order.scene_kinds = {{"0001", "urban"}, {"0002", "narrow"}};
  return summarise(test::few_records(), kBounds, order);
}

/// Records of `scenes` scenes, random in kind, place and end.
std::vector<TrialRecord> random_records(Rng& rng, ReportOrder& order, int scenes, bool has_truth) {
  std::vector<TrialRecord> records;
  for (int i = 0; i < scenes; ++i) {
    const std::string scene = "s" + std::to_string(i);
    if (rng.uniform() < 0.9) order.scene_kinds[scene] = rng.uniform() < 0.5 ? "urban" : "highway";
    for (const char* sensor : {"left", "right", "rear"}) {
      if (rng.uniform() < 0.2) continue;
      const TrialId id = {"base", scene, sensor, 0};
      const RigidTransform pose = moved({}, test::random_offset(rng, 0.3, 0.05));
      if (rng.uniform() < 0.2) {
        records.push_back(test::unfinished(id, Status::failed, "no ground"));
      } else if (has_truth) {
        records.push_back(test::finished(id, Status::success, pose, Vector6d::Zero()));
      } else {
        records.push_back(test::finished_without_truth(id, pose));
      }
    }
  }
  return records;
}

TEST(KindSummary, KindsTogetherAreTheSummary) {
  Rng rng = test_rng();
  for (int i = 0; i < 20; ++i) {
    ReportOrder order;
    const Summary summary = summarise(random_records(rng, order, 30, i % 2 == 0), kBounds, order);
    for (const SummaryRow& row : summary.rows) {
      int trials = 0, successes = 0, agreeing = 0, counted = 0, scenes = 0;
      for (const SceneKindSummary& kind : summary.scene_kinds) {
        if (kind.sensor != row.sensor) continue;
        EXPECT_EQ(kind.deviations_from, row.deviations_from);
        EXPECT_EQ(kind.success.trials, kind.outcomes.trials);
        trials += kind.outcomes.trials;
        successes += kind.success.count;
        agreeing += kind.agreement.count;
        counted += kind.counted;
        scenes += kind.scene_count;
      }
      EXPECT_EQ(trials, row.outcomes.trials);
      EXPECT_EQ(successes, row.success.count);
      EXPECT_EQ(agreeing, row.agreement.count);
      EXPECT_EQ(counted, row.counted);
      EXPECT_EQ(scenes, static_cast<int>(row.scenes.size()));
    }
  }
}

TEST(KindSummary, HasARowPerVariantKindAndSensorAndOneOverAllSensors) {
  const Summary summary = two_kinds();
  std::vector<std::string> names;
  for (const SceneKindSummary& kind : summary.scene_kinds) {
    names.push_back(kind.variant + "/" + kind.scene_kind + "/" + kind.sensor);
  }
  EXPECT_EQ(names, (std::vector<std::string>{
                       "base/narrow/left", "base/narrow/right", "base/narrow/", "base/urban/left",
                       "base/urban/right", "base/urban/", "no volume/narrow/left",
                       "no volume/narrow/right", "no volume/narrow/", "no volume/urban/left",
                       "no volume/urban/right", "no volume/urban/"}));
  const SceneKindSummary& all = summary.scene_kinds[2];
  EXPECT_EQ(all.scene_count, 1);
  EXPECT_EQ(all.outcomes.trials, 8);
  EXPECT_EQ(all.success.count, 6);
  EXPECT_EQ(all.outcomes.failed, 1);
  EXPECT_EQ(all.outcomes.rejected, 1);
  EXPECT_EQ(all.counted, 6);
  // Yaw is 0, 0.01 and 0.02 deg on both sensors.
  EXPECT_NEAR((*all.statistics)[2][statistic_index("median")], 0.01, 1e-9);
}

TEST(KindSummary, ChangesNothingElse) {
  const Summary with = two_kinds(), without = summarise(test::few_records(), kBounds, {});
  EXPECT_TRUE(without.scene_kinds.empty());
  EXPECT_EQ(summary_csv(with), summary_csv(without));
  const std::string json = summary_json(without);
  EXPECT_EQ(json.find("kind"), std::string::npos);
  // A new last key: up to the closing brace all is as before.
  EXPECT_EQ(summary_json(with).compare(0, json.size() - 3, json, 0, json.size() - 3), 0);
  EXPECT_EQ(test::summary_text(without).find("kind"), std::string::npos);
}

TEST(KindSummary, IsInJson) {
  const auto json = nlohmann::ordered_json::parse(summary_json(two_kinds()));
  EXPECT_EQ((--json.end()).key(), "kinds");
  ASSERT_EQ(json["kinds"].size(), 12U);
  EXPECT_EQ(json["kinds"][0]["sensor"], "left");
  EXPECT_TRUE(json["kinds"][2]["sensor"].is_null());
  EXPECT_EQ(json["kinds"][2]["kind"], "narrow");
  EXPECT_EQ(json["kinds"][2]["success"]["count"], 6);
}

TEST(KindSummary, IsInCsvWithEveryColumn) {
  const std::string csv = csv_of(scene_kind_columns(), two_kinds().scene_kinds);
  EXPECT_EQ(
      csv.rfind("variant,kind,sensor,reference,scenes,trials,success,inaccurate,finished,"
                "rejected,failed,success_ratio,success_low_ratio,success_high_ratio,agreement,"
                "agreement_ratio,agreement_low_ratio,agreement_high_ratio,counted,"
                "roll_mean_deg,",
                0),
      0U);
  EXPECT_NE(csv.find("\nbase,narrow,all,truth,1,8,6,0,0,1,1,0.75,"), std::string::npos) << csv;
  const auto header_end = csv.begin() + static_cast<std::ptrdiff_t>(csv.find('\n'));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 13);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 13 * std::count(csv.begin(), header_end, ','));
}

TEST(KindSummary, IsInTheTable) {
  const std::string text = test::summary_text(two_kinds());
  EXPECT_NE(text.find(R"(
Success by kind of scene, in %
variant    kind    scenes  trials   all  left  right
---------  ------  ------  ------  ----  ----  -----
base       narrow       1       8  75.0  75.0   75.0
base       urban        1       7  85.7  75.0  100.0
no volume  narrow       1       7  85.7  75.0  100.0
no volume  urban        1       7  85.7  75.0  100.0
)"),
            std::string::npos)
      << text;
}

TEST(KindSummary, WithoutTruthTheTableShowsAgreement) {
  ReportOrder order;
  order.scene_kinds = {{"0001", "urban"}};
  const std::string text =
      test::summary_text(summarise(test::one_of_four_astray(), kBounds, order));
  EXPECT_NE(text.find("\nurban       1       4  75.0  75.0\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace croon::experiments

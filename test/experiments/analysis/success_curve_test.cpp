#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/report/plots.hpp"
#include "experiments/report/result_tables.hpp"
#include "framework/base/angles.hpp"
#include "framework/picture/writers.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::kBounds;

/// Trials of two sensors in 8 scenes with errors of all sizes; some do not finish.
std::vector<TrialRecord> random_records() {
  Rng rng = croon::test::test_rng();
  std::vector<TrialRecord> records;
  for (const char* sensor : {"left", "right"}) {
    for (int trial = 0; trial < 80; ++trial) {
      const TrialId id = {"base", std::to_string(trial % 8), sensor, trial};
      if (rng.uniform() < 0.1) {
        records.push_back(test::unfinished(id, Status::failed, "no ground"));
        continue;
      }
      TrialRecord record =
          test::finished(id, Status::success, {}, test::random_offset(rng, 0.6, 0.12));
      const bool is_good = record.error->rotation_rad <= rad_from_deg(kBounds.rotation_deg) &&
                           record.error->translation_m <= kBounds.translation_m;
      record.status = is_good ? Status::success : Status::inaccurate;
      records.push_back(record);
    }
  }
  return records;
}

TEST(SuccessCurve, AtTheBoundsIsTheSuccess) {
  const Summary summary = summarise(random_records(), kBounds, {});
  const SuccessCurve& curve = summary.curve;
  ASSERT_EQ(curve.rows.size(), 9U);  // Two sensors and all, each with three curves.
  ASSERT_EQ(curve.thresholds.size(), 25U);
  EXPECT_EQ(curve.thresholds[12].rotation_deg, kBounds.rotation_deg);
  EXPECT_EQ(curve.thresholds[12].translation_m, kBounds.translation_m);
  EXPECT_EQ(curve.rows[2].of, CurveOf::both);
  EXPECT_EQ(curve.rows[2].shares[12].count, summary.rows[0].success.count);
  EXPECT_EQ(curve.rows[2].shares[12].trials, 80);
  EXPECT_EQ(curve.rows[8].sensor, "");
  EXPECT_EQ(curve.rows[8].shares[12].count,
            summary.rows[0].success.count + summary.rows[1].success.count);
  EXPECT_GT(curve.rows[8].shares[12].count, 10);
  EXPECT_TRUE(curve.rows[8].shares[12].interval);
}

TEST(SuccessCurve, RisesToTheTrialsThatFinished) {
  const std::vector<TrialRecord> records = random_records();
  const auto finished = std::count_if(records.begin(), records.end(),
                                      [](const auto& record) { return !!record.error; });
  const Summary summary = summarise(records, kBounds, {});
  for (const CurveRow& row : summary.curve.rows) {
    for (std::size_t i = 1; i < row.shares.size(); ++i) {
      EXPECT_GE(row.shares[i].count, row.shares[i - 1].count);
    }
  }
  for (const std::size_t row : {6U, 7U, 8U}) {
    EXPECT_EQ(summary.curve.rows[row].shares.back().count, finished);
    EXPECT_EQ(summary.curve.rows[row].shares.front().count, 0);
  }
  // Both is never more than either.
  for (std::size_t i = 0; i < 25; ++i) {
    EXPECT_LE(
        summary.curve.rows[8].shares[i].count,
        std::min(summary.curve.rows[6].shares[i].count, summary.curve.rows[7].shares[i].count));
  }
}

TEST(SuccessCurve, WithoutTruthOrWithBoundsOfZeroThereIsNone) {
  EXPECT_TRUE(summarise(test::one_of_four_astray(), kBounds, {}).curve.rows.empty());
  EXPECT_TRUE(summarise(random_records(), {0.0, 0.1}, {}).curve.rows.empty());
  const Summary tiny = summarise(random_records(), {1e-12, 1e-12}, {});
  EXPECT_EQ(svg_bytes(success_curve_chart(tiny.curve)).find("inf"), std::string::npos);
}

TEST(SuccessCurve, IsAFileWithARowPerThreshold) {
  const Summary summary = summarise(random_records(), kBounds, {});
  const std::string csv = success_curve_csv(summary.curve);
  EXPECT_EQ(csv.rfind("variant,sensor,of,rotation_deg,translation_m,trials,within,within_ratio,"
                      "within_low_ratio,within_high_ratio\nbase,left,rotation,0.005,,80,0,0,0,",
                      0),
            0U)
      << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 9 * 25);
  EXPECT_NE(csv.find("\nbase,all,both,0.5,0.1,160,"), std::string::npos);
  EXPECT_NE(csv.find("\nbase,all,translation,,0.1,160,"), std::string::npos);
  const std::string svg = svg_bytes(success_curve_chart(summary.curve));
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  for (const char* name :
       {">left</text>", ">right</text>", ">all sensors</text>", ">bound</text>"}) {
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  }
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace croon::experiments

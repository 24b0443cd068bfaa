#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/report/plots.hpp"
#include "experiments/report/result_list.hpp"
#include "framework/base/angles.hpp"
#include "framework/picture/writers.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/support/occurrences.hpp"
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

/// The records of `variants` variants, alike but for their names, in `scenes` scenes.
Summary variants_in(int variants, int scenes) {
  std::vector<TrialRecord> records;
  for (int variant = 0; variant < variants; ++variant) {
    for (TrialRecord record : random_records()) {
      record.id.variant = "v" + std::to_string(variant);
      record.id.scene = std::to_string(record.id.trial % scenes);
      records.push_back(record);
    }
  }
  return summarise(records, kBounds, {});
}

TEST(SuccessCurve, HasABandOfTheIntervalOverScenes) {
  const Summary summary = variants_in(2, kMinScenes);
  const Drawing drawing = success_curve_chart(summary.curve);
  EXPECT_THAT(test::unreadable_parts(drawing), testing::IsEmpty());
  std::vector<Drawing::Area> bands;
  std::vector<Drawing::Polyline> curves, edges;
  for (const Drawing::Element& element : drawing.elements()) {
    if (const auto* area = std::get_if<Drawing::Area>(&element)) {
      if (area->style.rfind("band", 0) == 0) bands.push_back(*area);
    }
    if (const auto* line = std::get_if<Drawing::Polyline>(&element)) {
      (line->style.rfind("curve", 0) == 0 ? curves : edges).push_back(*line);
    }
  }
  ASSERT_EQ(bands.size(), 2U * 2U);
  ASSERT_EQ(curves.size(), 2U * 2U);
  ASSERT_EQ(edges.size(), 2U * bands.size());
  for (std::size_t i = 0; i < bands.size(); ++i) {
    const std::size_t n = curves[i].corners.size();
    ASSERT_EQ(bands[i].corners.size(), 2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      const auto& [x, y] = curves[i].corners[k];
      const auto& [upper_x, upper] = bands[i].corners[k];
      const auto& [lower_x, lower] = bands[i].corners[2 * n - 1 - k];
      EXPECT_EQ(x, upper_x);
      EXPECT_EQ(x, lower_x);
      EXPECT_LE(upper, y + 1e-9);  // Upwards is less.
      EXPECT_GE(lower, y - 1e-9);
    }
    // The dashes of the edges are those of the line, so they differ without colours.
    EXPECT_EQ(look_of(edges[2 * i].style, {}).dashes, look_of(curves[i].style, {}).dashes);
  }
  EXPECT_NE(drawing.description().find("bands: 95 % interval over scenes"), std::string::npos);
}

TEST(SuccessCurve, HasNoBandForTooFewScenesAndOneForManyLines) {
  const auto bands = [](const Summary& summary) {
    return test::occurrences(svg_bytes(success_curve_chart(summary.curve, {kOneColumn})),
                             "class=\"band ");
  };
  EXPECT_EQ(bands(variants_in(2, kMinScenes - 1)), 0U);
  EXPECT_EQ(bands(variants_in(4, 8)), 2U * 4U);
  EXPECT_EQ(bands(variants_in(5, 8)), 2U);
  EXPECT_NE(success_curve_chart(variants_in(5, 8).curve).description().find("band of v0:"),
            std::string::npos);
  // Sensors of one variant: all together.
  EXPECT_EQ(bands(variants_in(1, 8)), 2U);
  EXPECT_NE(success_curve_chart(variants_in(1, 8).curve).description().find("band of all sensors:"),
            std::string::npos);
}

TEST(SuccessCurve, IsAFileWithARowPerThreshold) {
  Results results;
  results.summary = summarise(random_records(), kBounds, {});
  const std::string csv = result_file("success_curve.csv", results);
  EXPECT_EQ(csv.rfind("variant,sensor,of,rotation_deg,translation_m,trials,within,within_ratio,"
                      "within_low_ratio,within_high_ratio\nbase,left,rotation,0.005,,80,0,0,0,",
                      0),
            0U)
      << csv;
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 9 * 25);
  EXPECT_NE(csv.find("\nbase,all,both,0.5,0.1,160,"), std::string::npos);
  EXPECT_NE(csv.find("\nbase,all,translation,,0.1,160,"), std::string::npos);
  const std::string svg = result_file("success_curve.svg", results);
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

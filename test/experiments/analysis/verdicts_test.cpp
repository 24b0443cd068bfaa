#include "experiments/analysis/verdicts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "experiments/report/figures.hpp"
#include "experiments/report/plots.hpp"
#include "experiments/report/result_list.hpp"
#include "experiments/report/result_sections.hpp"
#include "framework/document/renderers.hpp"
#include "framework/picture/writers.hpp"
#include "test/experiments/support/readable.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using test::kBounds;
using ::testing::HasSubstr;

/// A trial of `sensor` that ends `x_m` from the truth.
TrialRecord ended(const std::string& sensor, int trial, Status status, double x_m) {
  return test::finished({"base", std::to_string(trial), sensor, 0}, status, {},
                        test::offset_of(0, 0, 0, x_m, 0, 0));
}

/// Of left 3 accepted and right, 1 accepted and wrong, 2 rejected and right, 1 rejected and wrong,
/// 1 failed; of right 1 accepted and right.
std::vector<TrialRecord> some_records() {
  const double near = 0.5 * kBounds.translation_m, far = 3.0 * kBounds.translation_m;
  std::vector<TrialRecord> records;
  for (int i : {0, 1, 2}) records.push_back(ended("left", i, Status::success, near));
  records.push_back(ended("left", 3, Status::inaccurate, far));
  for (int i : {4, 5}) records.push_back(ended("left", i, Status::rejected, near));
  records.push_back(ended("left", 6, Status::rejected, far));
  records.push_back(test::unfinished({"base", "7", "left", 0}, Status::failed, "no ground"));
  records.push_back(ended("right", 0, Status::success, near));
  return records;
}

AcceptanceCurve verdicts_on(const std::vector<TrialRecord>& records) {
  return acceptance_of(records, summarise(records, kBounds, {}));
}

TEST(Verdicts, CountRightAndWrongAgainstAcceptedAndRejected) {
  const AcceptanceCurve acceptance = verdicts_on(some_records());
  ASSERT_EQ(acceptance.rows.size(), 3U);
  const AcceptanceCounts& left = acceptance.rows[0].at_bounds;
  EXPECT_EQ(acceptance.rows[0].sensor, "left");
  EXPECT_EQ(left.accepted_right, 3);
  EXPECT_EQ(left.accepted_wrong, 1);
  EXPECT_EQ(left.rejected_right, 2);
  EXPECT_EQ(left.rejected_wrong, 1);
  EXPECT_EQ(left.failed, 1);
  EXPECT_EQ(acceptance.rows[1].at_bounds.accepted_right, 1);
  EXPECT_EQ(acceptance.rows[2].sensor, "");
  EXPECT_EQ(acceptance.rows[2].at_bounds.accepted_right, 4);
  EXPECT_EQ(acceptance.rows[2].at_bounds.trials(), 9);
}

TEST(Verdicts, OverTheThresholdTheNumberOfTrialsStays) {
  const AcceptanceCurve acceptance = verdicts_on(some_records());
  for (const AcceptanceRow& row : acceptance.rows) {
    ASSERT_EQ(row.at_thresholds.size(), acceptance.thresholds.size());
    int last = 0;
    for (const AcceptanceCounts& counts : row.at_thresholds) {
      EXPECT_EQ(counts.trials(), row.at_bounds.trials());
      EXPECT_GE(counts.accepted_right + counts.rejected_right, last);
      last = counts.accepted_right + counts.rejected_right;
    }
    EXPECT_EQ(row.at_thresholds.front().accepted_right, 0);
    EXPECT_EQ(row.at_thresholds.back().accepted_wrong, 0);
    EXPECT_EQ(row.at_thresholds[12].accepted_right, row.at_bounds.accepted_right);
  }
}

TEST(Verdicts, HaveAFigureWithAPanelForEachOfTheFour) {
  const AcceptanceCurve acceptance = verdicts_on(some_records());
  const Drawing drawing = acceptance_chart(acceptance, kBounds);
  EXPECT_THAT(test::unreadable_parts(drawing), testing::IsEmpty());
  const std::string picture = svg_bytes(drawing);
  for (const char* title :
       {"accepted and right", "accepted and wrong", "rejected and right", "rejected and wrong"}) {
    EXPECT_THAT(picture, HasSubstr(std::string(">") + title + "<"));
  }
  for (const char* sensor : {"left", "right", "all sensors"}) {
    EXPECT_THAT(picture, HasSubstr(std::string(">") + sensor + "<"));
  }
}

TEST(Verdicts, OfChosenTrialsCountTheseAlone) {
  Results results;
  results.records = some_records();
  results.trials = 1;
  results.summary = summarise(results.records, kBounds, {});
  results.acceptance = acceptance_of(results.records, results.summary);
  EXPECT_EQ(results.acceptance.rows.back().at_bounds.trials(), 9);
  const Results left = restricted(results, {{}, {"left"}, {}});
  EXPECT_EQ(left.acceptance.rows.back().at_bounds.trials(), 8);
}

TEST(Verdicts, WithABoundOfZeroAreATableAndNoCurve) {
  const std::vector<TrialRecord> records = some_records();
  const AcceptanceCurve acceptance = acceptance_of(records, summarise(records, {0.0, 0.1}, {}));
  EXPECT_FALSE(acceptance.rows.empty());
  EXPECT_FALSE(has_curve(acceptance));
  EXPECT_TRUE(has_curve(verdicts_on(records)));
  Results results;
  results.acceptance = acceptance;
  EXPECT_EQ(result_file("verdicts.csv", results), "");
}

TEST(Verdicts, DoNotCountFailuresOfASensorWithoutTruth) {
  std::vector<TrialRecord> records = some_records();
  records.push_back(test::unfinished({"base", "0", "back", 0}, Status::failed, "no ground"));
  ReportOrder order;
  order.without_truth = {"back"};
  const AcceptanceCurve acceptance = acceptance_of(records, summarise(records, kBounds, order));
  EXPECT_EQ(acceptance.rows.back().at_bounds.trials(), 9);
}

TEST(Verdicts, AreThereOnlyWhereTheProgramGaveOne) {
  std::vector<TrialRecord> records = some_records();
  const auto is_rejected = [](const TrialRecord& one) { return one.status == Status::rejected; };
  records.erase(std::remove_if(records.begin(), records.end(), is_rejected), records.end());
  EXPECT_TRUE(verdicts_on(records).rows.empty());
  for (TrialRecord& record : records) record.error.reset();
  EXPECT_TRUE(verdicts_on(records).rows.empty());
}

TEST(Verdicts, AreATableAndAFile) {
  Results results;
  results.acceptance = verdicts_on(some_records());
  const std::string csv = result_file("verdicts.csv", results);
  EXPECT_EQ(csv.rfind("variant,sensor,rotation_deg,translation_m,trials,accepted_right,"
                      "accepted_wrong,rejected_right,rejected_wrong,failed\n",
                      0),
            0U);
  EXPECT_THAT(csv, HasSubstr("\nbase,left,0.5,0.1,8,3,1,2,1,1\n"));
  EXPECT_THAT(csv, HasSubstr("\nbase,all,0.5,0.1,9,4,1,2,1,1\n"));
  EXPECT_THAT(text_section(verdicts_section(results)), HasSubstr("accepted, wrong"));
}

}  // namespace
}  // namespace croon::experiments

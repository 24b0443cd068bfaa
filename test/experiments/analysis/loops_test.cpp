#include "experiments/analysis/summary.hpp"

#include <gtest/gtest.h>

#include "experiments/report/result_tables.hpp"
#include "framework/table/renderers.hpp"
#include "test/experiments/support/summary_text.hpp"
#include "test/support/random_geometry.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

using croon::test::random_pose;
using croon::test::test_rng;
using test::kBounds;

/// Three links of `trials` loops in each of some scenes; the pair is off by `gap`, as the loop is.
std::vector<TrialRecord> records_with(const Vector6d& gap, int trials, int scenes = 2) {
  Rng rng = test_rng();
  std::vector<TrialRecord> records;
  for (int i = 0; i < scenes; ++i) {
    const std::string scene = std::to_string(i);
    for (int trial = 0; trial < trials; ++trial) {
      const RigidTransform left = random_pose(rng, 3.0);
      const RigidTransform front = random_pose(rng, 3.0);
      const RigidTransform pair = front.inverse() * moved(left, gap);
      const auto add = [&](const char* sensor, const RigidTransform& pose) {
        records.push_back(test::finished_without_truth({"base", scene, sensor, trial}, pose));
      };
      add("front", front);
      add("left", left);
      add("left>front", pair);
    }
  }
  return records;
}

ReportOrder order() {
  ReportOrder order;
  order.pairs = {sensor_pair("left", "front")};
  return order;
}

TEST(LoopClosure, FindsTheGapThatWasPutIn) {
  Rng rng = test_rng(2);
  for (int i = 0; i < 10; ++i) {
    const double yaw_deg = rng.uniform(-0.4, 0.4);
    const Vector6d gap = test::offset_of(0, 0, yaw_deg, 0.03, -0.04, 0.0);
    const Summary summary = summarise(records_with(gap, 3), kBounds, order());
    ASSERT_EQ(summary.loops.size(), 1U);
    const LoopClosure& loop = summary.loops[0];
    EXPECT_EQ(loop.pair.name, "left>front");
    EXPECT_EQ(loop.closed.count, 6);
    EXPECT_EQ(loop.counted, 6);
    EXPECT_NEAR((*loop.statistics)[2][statistic_index("mean")], yaw_deg, 1e-9);
    EXPECT_NEAR((*loop.statistics)[kDofs][statistic_index("median")], std::abs(yaw_deg), 1e-9);
    EXPECT_NEAR((*loop.statistics)[kDofs + 1][statistic_index("median")], 0.05, 1e-9);
  }
}

TEST(LoopClosure, CountsWhatDidNotFinishAsOpen) {
  std::vector<TrialRecord> records = records_with(Vector6d::Zero(), 4);
  records[0].status = Status::failed;
  records[0].T_reference_sensor.reset();
  records[4].status = Status::rejected;
  const LoopClosure loop = summarise(records, kBounds, order()).loops.at(0);
  EXPECT_EQ(loop.closed.trials, 8);
  EXPECT_EQ(loop.closed.count, 6);
  EXPECT_EQ(loop.counted, 6);
}

TEST(LoopClosure, OfWideGapsIsOpen) {
  const Vector6d gap = test::offset_of(0, 0, 2.0, 0, 0, 0);
  const LoopClosure loop = summarise(records_with(gap, 2), kBounds, order()).loops.at(0);
  EXPECT_EQ(loop.closed.count, 0);
  EXPECT_EQ(loop.counted, 4);
}

/// Two scenes with starts that end at the same three poses, but for one of five.
TEST(LoopClosure, OverAgreedPosesIgnoresTrialsThatGoAstray) {
  Rng rng = test_rng();
  const RigidTransform left = random_pose(rng, 3.0), front = random_pose(rng, 3.0);
  const Vector6d gap = test::offset_of(0, 0, 0.25, 0.03, -0.04, 0.0);
  std::vector<TrialRecord> records;
  for (const char* scene : {"0", "1"}) {
    for (int trial = 0; trial < 5; ++trial) {
      const auto add = [&](const char* sensor, const RigidTransform& pose) {
        records.push_back(test::finished_without_truth({"base", scene, sensor, trial},
                                                       trial == 3 ? random_pose(rng, 9.0) : pose));
      };
      add("front", front);
      add("left", left);
      add("left>front", front.inverse() * moved(left, gap));
    }
  }
  const LoopClosure loop = summarise(records, kBounds, order()).loops.at(0);
  EXPECT_EQ(loop.closed.count, 8);
  EXPECT_EQ(loop.scenes, 2);
  EXPECT_EQ(loop.scenes_closed, 2);
  ASSERT_TRUE(loop.agreed);
  EXPECT_TRUE(loop.agreed->is_closed);
  EXPECT_NEAR(loop.agreed->deviations[2], 0.25, 1e-9);
  EXPECT_NEAR(loop.agreed->deviations[kTranslation], 0.05, 1e-9);
}

TEST(LoopClosure, NeedsAllThreeLinks) {
  std::vector<TrialRecord> records = records_with(Vector6d::Zero(), 1);
  records.erase(records.begin());
  EXPECT_EQ(summarise(records, kBounds, order()).loops.at(0).closed.trials, 1);
  records.resize(2);
  EXPECT_TRUE(summarise(records, kBounds, order()).loops.empty());
}

TEST(LoopClosure, IsInEveryReport) {
  const Vector6d gap = test::offset_of(0, 0, 0.25, 0.03, -0.04, 0.0);
  const Summary summary = summarise(records_with(gap, 1, 6), kBounds, order());
  const std::string table = test::summary_text(summary);
  EXPECT_NE(table.find("left>front     6/6  100.0  [61.0, 100.0]  0.250, 0.250  0.0500, 0.0500"),
            std::string::npos)
      << table;
  const std::string csv = csv_of(loop_columns(), summary.loops);
  EXPECT_EQ(csv.substr(0, csv.find("_mean")),
            "variant,pair,source,target,loops,closed,closed_ratio,closed_low_ratio,"
            "closed_high_ratio,counted,roll");
  EXPECT_NE(csv.find("\nbase,left>front,left,front,6,6,1,"), std::string::npos) << csv;
  EXPECT_NE(summary_json(summary).find(R"("pair": "left>front")"), std::string::npos);
}

}  // namespace
}  // namespace croon::experiments

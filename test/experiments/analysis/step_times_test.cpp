#include "experiments/analysis/step_times.hpp"

#include <gtest/gtest.h>

#include "test/support/temp_folder.hpp"
#include "test/support/trial_records.hpp"

namespace croon::experiments {
namespace {

Done timed_steps(const TrialId& id, std::vector<std::pair<std::string, double>> steps) {
  Done done;
  for (const auto& [step, seconds] : steps) done.timings.push_back({id, step, seconds});
  return done;
}

TEST(StepTimes, AreMediansOverTheTrialsOfTheSummary) {
  const test::TempFolder folder;
  TimingsStore timings(folder.path() / "t", Access::write);
  std::vector<TrialRecord> records;
  for (int trial = 0; trial < 3; ++trial) {
    const TrialId id = {"base", "s", "left", trial};
    records.push_back(test::unfinished(id, Status::failed, "no ground"));
    timings.add({timed_steps(id, {{"yaw", 1.0 + trial}, {"icp", 0.5}})});
    timings.add({timed_steps({"base", "s", "right", trial}, {{"yaw", 9.0}})});
    timings.add({timed_steps({"a", "s", "left", trial}, {{"icp", 0.25}})});
  }
  records.push_back(test::unfinished({"a", "s", "left", 0}, Status::failed, "no ground"));
  timings.add({timed_steps({"", "s", "left", -1}, {{"reading", 9.0}})});
  ReportOrder order;
  order.variants = {"base", "a"};
  const auto times = step_times(timings, summarise(records, test::kBounds, order));
  ASSERT_EQ(times.size(), 3U);
  EXPECT_EQ(times[0].variant + " " + times[0].step, "base yaw");
  EXPECT_EQ(times[0].median_s, 2.0);
  EXPECT_EQ(times[1].step, "icp");
  EXPECT_EQ(times[2].variant + " " + times[2].step, "a icp");
  EXPECT_EQ(times[2].median_s, 0.25);
}

}  // namespace
}  // namespace croon::experiments

#include "experiments/engine/trial_plan.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

Experiment experiment_with(const std::vector<std::string>& variants, int trials) {
  Experiment experiment;
  for (const std::string& name : variants) experiment.variants.push_back({name, {}, ""});
  experiment.starts.trials = trials;
  return experiment;
}

std::vector<Scene> two_scenes() {
  const auto scan = [](const std::string& sensor) {
    return SensorScan{sensor, "", {}, {}, {}, {}};
  };
  return {{"z", "", scan("top"), {scan("right"), scan("left")}},
          {"a", "", scan("top"), {scan("left")}}};
}

TEST(Shard, ReadsKOfN) {
  EXPECT_EQ(read_shard("2/3").part, 2);
  EXPECT_EQ(read_shard("2/3").parts, 3);
  for (const char* text :
       {"", "2", "0/3", "4/3", "2/", "/3", "-1/3", "1/0", "1/2/3", "a/b", "1.0/2", " 1/2"}) {
    EXPECT_THROW(read_shard(text), InputError) << text;
  }
}

TEST(Plan, ShardsAreDisjointAndTogetherAreAll) {
  const Experiment experiment = experiment_with({"base", "other"}, 7);
  std::set<std::tuple<std::size_t, std::size_t, std::size_t, int>> seen;
  for (int part = 1; part <= 3; ++part) {
    for (const PlannedTrial& p : plan_trials(experiment, two_scenes(), {{0, 1}, {part, 3}})) {
      EXPECT_EQ(p.trial % 3, part - 1);
      EXPECT_TRUE(seen.insert({p.scene, p.variant, p.sensor, p.trial}).second);
    }
  }
  EXPECT_EQ(seen.size(), 2U * 3U * 7U);
  EXPECT_EQ(plan_trials(experiment, two_scenes(), {{0, 1}, {}}).size(), seen.size());
}

TEST(Plan, OnlySelectsAVariantWithItsGrid) {
  const Experiment experiment = experiment_with({"base/a", "base/b", "based/a"}, 1);
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(select_variants(experiment, {}), (Places{0, 1, 2}));
  EXPECT_EQ(select_variants(experiment, {"base"}), (Places{0, 1}));
  EXPECT_EQ(select_variants(experiment, {"based/a", "base/a"}), (Places{0, 2}));
  try {
    select_variants(experiment, {"based/b", "zzzzzzzzz"});
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 2U);
    EXPECT_EQ(error.faults()[0].line(),
              "--only: there is no variant \"based/b\"; did you mean \"base/b\"?");
  }
}

TEST(Plan, ReportsAreInTheOrderOfExperimentAndDataset) {
  const Experiment experiment = experiment_with({"x", "b"}, 2);
  std::vector<TrialRecord> records;
  for (const PlannedTrial& planned : plan_trials(experiment, two_scenes(), {{0, 1}, {}})) {
    TrialRecord record;
    record.id = trial_id(experiment, two_scenes(), planned);
    records.insert(records.begin(), record);
  }
  std::string order;
  for (const TrialRecord& r : in_report_order(records, experiment, two_scenes())) {
    order +=
        r.id.variant + r.id.scene + r.id.sensor.substr(0, 1) + std::to_string(r.id.trial) + " ";
  }
  EXPECT_EQ(order, "xzr0 xzr1 xzl0 xzl1 xal0 xal1 bzr0 bzr1 bzl0 bzl1 bal0 bal1 ");
}

}  // namespace
}  // namespace croon::experiments

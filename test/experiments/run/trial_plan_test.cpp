#include "experiments/run/trial_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "framework/base/error.hpp"
#include "test/support/random_geometry.hpp"

namespace croon::experiments {
namespace {

Experiment experiment_with(const std::vector<std::string>& variants, int trials) {
  Experiment experiment;
  for (const std::string& name : variants) experiment.variants.push_back({name, {}});
  experiment.starts.trials = trials;
  return experiment;
}

std::vector<SceneGroup> two_scenes() {
  const CalibratedPair left = {{"left", "left", "top"}, {}, {}, {}};
  const CalibratedPair right = {{"right", "right", "top"}, {}, {}, {}};
  return {{"z", "", {{}}, {right, left}}, {"a", "", {{}}, {left}}};
}

TEST(Shard, ReadsKOfN) {
  EXPECT_EQ(read_shard("2/3").part, 2);
  EXPECT_EQ(read_shard("2/3").parts, 3);
  for (const char* text :
       {"", "2", "0/3", "4/3", "2/", "/3", "-1/3", "1/0", "1/2/3", "a/b", "1.0/2", " 1/2"}) {
    EXPECT_THROW(read_shard(text), InputError) << text;
  }
}

/// The trials of `plan` by (variant, scene, sensor of all scenes, trial); fails where one is there
/// twice.
std::set<TrialIndex> places(const Plan& plan, const std::vector<SceneGroup>& scenes) {
  const std::vector<std::string> names = sensor_names(scenes);
  std::set<TrialIndex> found;
  for (const PlannedStart& start : plan.starts) {
    const std::string& name = scenes[start.scene].pairs[start.sensor].name;
    const auto sensor = std::find(names.begin(), names.end(), name) - names.begin();
    for (const std::size_t variant : plan.variants[start.variants]) {
      const TrialIndex place = {variant, start.scene, static_cast<std::size_t>(sensor),
                                start.trial};
      EXPECT_TRUE(found.insert(place).second);
    }
  }
  EXPECT_EQ(found.size(), plan.trials);
  return found;
}

TEST(Plan, ShardsAreDisjointAndTogetherAreAll) {
  for (const int trials : {1, 2, 7, 100}) {
    const Experiment experiment = experiment_with({"base", "other"}, trials);
    const std::set<TrialIndex> all =
        places(plan_trials(experiment, two_scenes(), {{0, 1}, {}}), two_scenes());
    EXPECT_EQ(all.size(), 2U * 3U * static_cast<std::size_t>(trials));
    for (const int parts : {1, 2, 3, 8, 1000000000}) {
      std::set<TrialIndex> seen;
      for (int part = 1; part <= std::min(parts, 8); ++part) {
        const Plan shard = plan_trials(experiment, two_scenes(), {{0, 1}, {part, parts}});
        // No shard has more than its share of (scene, trial) pairs, each with all sensors.
        EXPECT_LE(shard.trials, 2U * 2U * ((2U * trials + parts - 1U) / parts));
        for (const TrialIndex& place : places(shard, two_scenes())) {
          EXPECT_TRUE(seen.insert(place).second);
        }
      }
      if (parts <= 8) {
        EXPECT_EQ(seen, all);
      }
    }
  }
}

TEST(Plan, AShardOfManyScenesNeedsFewOfThem) {
  const Experiment experiment = experiment_with({"base"}, 1);
  const Plan first = plan_trials(experiment, two_scenes(), {{0}, {1, 2}});
  for (const PlannedStart& start : first.starts) EXPECT_EQ(start.scene, 0U);
  EXPECT_EQ(first.trials, 2U);
}

TEST(Plan, LeavesOutWhatIsDone) {
  const Experiment experiment = experiment_with({"a", "b", "c"}, 5);
  const Selection all_of_it = {{0, 1, 2}, {}};
  const std::set<TrialIndex> all =
      places(plan_trials(experiment, two_scenes(), all_of_it), two_scenes());
  Rng rng = test::test_rng();
  for (int i = 0; i < 50; ++i) {
    std::vector<TrialIndex> done;
    for (const TrialIndex& place : all) {
      if (rng.below(2) == 0) done.push_back(place);
    }
    // Of an experiment that once had more.
    done.push_back({2, 7, 0, 3});
    const std::set<TrialIndex> left =
        places(plan_trials(experiment, two_scenes(), all_of_it, done), two_scenes());
    std::set<TrialIndex> together = left;
    together.insert(done.begin(), done.end());
    EXPECT_EQ(left.size() + done.size() - 1, all.size());
    EXPECT_EQ(together.size(), all.size() + 1);
  }
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

TEST(Plan, RunsByScene) {
  const Experiment experiment = experiment_with({"x", "b"}, 2);
  std::string order;
  for (const PlannedStart& start : plan_trials(experiment, two_scenes(), {{0, 1}, {}}).starts) {
    order += std::to_string(start.scene) + std::to_string(start.sensor) +
             std::to_string(start.trial) + " ";
  }
  EXPECT_EQ(order, "000 001 010 011 100 101 ");
}

}  // namespace
}  // namespace croon::experiments

#include "experiments/run/scene_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "experiments/run/runner.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// An experiment with the given scenes of one rig, in groups of `size`.
Experiment in_groups(int scenes, int size, const std::string& members = "",
                     const std::string& dataset = R"(, "one_rig": true)",
                     const std::string& pipeline = R"([{"step": "drift"}, {"step": "gather"}])") {
  const test::TempFolder folder;
  return load_experiment(
      folder.write("x.json", R"({"name": "x", "dataset": {"type": "fake", "scenes": )" +
                                 std::to_string(scenes) + dataset + R"(}, "scenes_per_trial": )" +
                                 std::to_string(size) + members + R"(, "starts": {"trials": 2},
                                 "pipeline": )" +
                                 pipeline + "}"),
      test::fake_catalogue());
}

/// The scenes of each group by name.
std::vector<std::vector<std::string>> members_of(const std::vector<SceneGroup>& groups) {
  std::vector<std::vector<std::string>> members;
  for (const SceneGroup& group : groups) {
    members.emplace_back();
    for (const Scene& scene : group.scenes) members.back().push_back(scene.name);
  }
  return members;
}

TEST(SceneGroups, ShareNoSceneAndLeaveOutTheRest) {
  const std::vector<SceneGroup> groups = scene_groups(in_groups(17, 5), "");
  ASSERT_EQ(groups.size(), 3U);
  std::set<std::string> seen;
  for (const std::vector<std::string>& group : members_of(groups)) {
    EXPECT_EQ(group.size(), 5U);
    for (const std::string& name : group) EXPECT_TRUE(seen.insert(name).second) << name;
  }
  EXPECT_EQ(seen.size(), 15U);
}

TEST(SceneGroups, HaveTheNameOfTheFirstSceneInTheOrderOfTheDataset) {
  const Experiment experiment = in_groups(12, 4);
  std::map<std::string, std::size_t> index;
  for (const Scene& scene : dataset_scenes(experiment, "")) index.emplace(scene.name, index.size());
  std::size_t last = 0;
  for (const SceneGroup& group : scene_groups(experiment, "")) {
    EXPECT_EQ(group.name, group.scenes.front().name + "+3");
    const auto before = [&](const Scene& a, const Scene& b) {
      return index[a.name] < index[b.name];
    };
    EXPECT_TRUE(std::is_sorted(group.scenes.begin(), group.scenes.end(), before));
    EXPECT_GE(index[group.scenes.front().name], last);
    last = index[group.scenes.front().name];
  }
}

TEST(SceneGroups, AreDrawnFromTheSeedAlone) {
  const auto groups = [](const std::string& members) {
    return members_of(scene_groups(in_groups(20, 5, members), ""));
  };
  EXPECT_EQ(groups(""), groups(R"(, "loops": true)"));
  EXPECT_EQ(groups(""), groups(R"(, "seed": 1)"));
  EXPECT_NE(groups(""), groups(R"(, "seed": 2)"));
}

TEST(SceneGroups, EachSceneIsAsOftenWithEachOther) {
  // How often scene 0 of six is with each other over many seeds: 1 in 5 each.
  std::map<std::string, int> with_first;
  constexpr int kSeeds = 1000;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Experiment experiment = in_groups(6, 2, R"(, "seed": )" + std::to_string(seed));
    ++with_first[scene_groups(experiment, "").front().scenes.back().name];
  }
  EXPECT_EQ(with_first.size(), 5U);
  // Five standard deviations of a binomial share.
  for (const auto& [name, count] : with_first) EXPECT_NEAR(count, 200, 64) << name;
}

TEST(SceneGroups, OneSceneEachIsAsItWas) {
  const std::vector<SceneGroup> groups = scene_groups(in_groups(3, 1), "");
  ASSERT_EQ(groups.size(), 3U);
  for (const SceneGroup& group : groups) {
    ASSERT_EQ(group.scenes.size(), 1U);
    EXPECT_EQ(group.name, group.scenes.front().name);
  }
}

TEST(SceneGroups, OfSeveralKindsAreMixed) {
  for (const SceneGroup& group :
       scene_groups(in_groups(4, 4, "", R"(, "one_rig": true, "kinds": true)"), "")) {
    EXPECT_EQ(group.kind, "mixed");
  }
}

TEST(SceneGroups, AreRefusedWithoutACommonRigOrEnoughScenes) {
  EXPECT_THAT(test::input_error([] { scene_groups(in_groups(4, 5), ""); }),
              HasSubstr("/scenes_per_trial: expected at most the number of scenes, 4, found 5"));
  EXPECT_THAT(test::input_error([] { scene_groups(in_groups(4, 2, "", ""), ""); }),
              HasSubstr("/scenes_per_trial: expected the same rig in all scenes of a trial, found "
                        "different true poses of sensor \"s1\" in scenes"));
  EXPECT_THAT(test::input_error([] { in_groups(4, 0); }), HasSubstr("/scenes_per_trial"));
}

std::vector<TrialRecord> run(const Experiment& experiment, const Plan* only = nullptr) {
  const std::vector<SceneGroup> groups = scene_groups(experiment, "");
  std::vector<TrialRecord> records;
  RunListener listener;
  listener.on_trial = [&](const TrialRecord& record, const auto&) { records.push_back(record); };
  const Plan all = plan_trials(experiment, groups, {select_variants(experiment, {}), {}});
  run_trials(experiment, groups, only == nullptr ? all : *only, 2, listener);
  return records;
}

TEST(Rigs, AStepSeesAllScenesAndSensorsOfATrial) {
  const std::vector<TrialRecord> records = run(in_groups(6, 3));
  ASSERT_EQ(records.size(), 2U * 2U * 2U);  // Groups, sensors, trials.
  for (const TrialRecord& record : records) {
    ASSERT_EQ(record.steps.size(), 2U);
    EXPECT_EQ(record.steps[1].diagnostics.front().second, 6.0);
    for (const TrialRecord& other : records) {
      const bool is_same_rig =
          record.id.scene == other.id.scene && record.id.trial == other.id.trial;
      EXPECT_EQ(
          record.T_reference_sensor->translation.x() == other.T_reference_sensor->translation.x(),
          is_same_rig);
    }
  }
}

TEST(Rigs, PairsOfSensorsAreEstimatesOfTheRig) {
  const std::vector<TrialRecord> records = run(in_groups(4, 2, R"(, "loops": true)"));
  for (const TrialRecord& record : records) {
    EXPECT_EQ(record.steps[1].diagnostics.front().second, 2.0 * 3.0);
  }
}

TEST(Rigs, WorkWithOneSceneToo) {
  for (const TrialRecord& record : run(in_groups(2, 1))) {
    EXPECT_EQ(record.steps[1].diagnostics.front().second, 2.0);
  }
}

TEST(Rigs, APartOfATrialIsTheSameWhenTheRestIsThere) {
  const Experiment experiment = in_groups(6, 3);
  const std::vector<TrialRecord> all = run(experiment);
  Plan one = plan_trials(experiment, scene_groups(experiment, ""), {{0}, {}});
  one.starts.erase(one.starts.begin() + 1, one.starts.end());
  const std::vector<TrialRecord> alone = run(experiment, &one);
  ASSERT_EQ(alone.size(), 1U);
  const auto is_it = [&](const TrialRecord& record) {
    return std::tie(record.id.scene, record.id.sensor, record.id.trial) ==
           std::tie(alone[0].id.scene, alone[0].id.sensor, alone[0].id.trial);
  };
  const auto same = std::find_if(all.begin(), all.end(), is_it);
  ASSERT_NE(same, all.end());
  EXPECT_EQ(same->T_reference_sensor->translation, alone[0].T_reference_sensor->translation);
}

TEST(Rigs, ASceneThatDefeatsAStepDoesNotEndTheTrial) {
  // The cloud of one sensor is damaged in all scenes: the other goes on without it.
  const std::vector<TrialRecord> records =
      run(in_groups(4, 2, "", R"(, "one_rig": true, "unreadable": 0)"));
  for (const TrialRecord& record : records) {
    if (record.id.sensor == "s1") {
      EXPECT_EQ(record.status, Status::failed);
      EXPECT_THAT(record.reason, HasSubstr("in all scenes; in " + std::string("scene")));
      EXPECT_THAT(record.reason, HasSubstr("the cloud of s1: byte 7"));
    } else {
      EXPECT_NE(record.status, Status::failed);
      EXPECT_EQ(record.steps[1].diagnostics.front().second, 2.0);
    }
  }
}

TEST(Rigs, AReasonSaysWhichScenesAreLost) {
  // In one of two scenes the cloud of one sensor is damaged.
  int with_a_reason = 0;
  for (const TrialRecord& record :
       run(in_groups(2, 2, "", R"(, "one_rig": true, "unreadable": 0, "unreadable_scene": 0)"))) {
    EXPECT_NE(record.status, Status::failed);
    if (record.id.sensor != "s1") {
      EXPECT_THAT(record.reason, Not(HasSubstr("failed")));
      continue;
    }
    EXPECT_THAT(record.reason, HasSubstr("1 of 2 scenes failed, in scene"));
    EXPECT_THAT(record.reason, HasSubstr("the cloud of s1: byte 7"));
    ++with_a_reason;
  }
  EXPECT_GT(with_a_reason, 0);
}

TEST(Rigs, ADamagedCloudIsSaid) {
  const Experiment experiment = in_groups(4, 2, "", R"(, "one_rig": true, "unreadable": 0)");
  const std::vector<SceneGroup> groups = scene_groups(experiment, "");
  std::vector<std::string> reasons;
  RunListener listener;
  listener.on_damaged = [&](const std::string& reason) { reasons.push_back(reason); };
  run_trials(experiment, groups,
             plan_trials(experiment, groups, {select_variants(experiment, {}), {}}), 2, listener);
  ASSERT_EQ(reasons.size(), 4U);
  EXPECT_THAT(reasons.front(), HasSubstr(": the cloud of s1: byte 7"));
}

TEST(Rigs, GroupsWithoutARigStepGiveOnePosePerSensor) {
  const std::vector<TrialRecord> records =
      run(in_groups(6, 3, "", R"(, "one_rig": true)", R"([{"step": "drift"}])"));
  EXPECT_EQ(records.size(), 2U * 2U * 2U);
  for (const TrialRecord& record : records) EXPECT_TRUE(record.T_reference_sensor);
}

}  // namespace
}  // namespace croon::experiments

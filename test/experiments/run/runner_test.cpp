#include "experiments/run/runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <tuple>

#include "experiments/file/experiment.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;

struct Ran {
  std::vector<TrialRecord> records;  ///< By id.
  std::vector<TimingRow> timings;
};

auto key_of(const TrialId& id) { return std::tie(id.variant, id.scene, id.sensor, id.trial); }

void sort_by_id(std::vector<TrialRecord>& records) {
  std::sort(records.begin(), records.end(),
            [](const TrialRecord& a, const TrialRecord& b) { return key_of(a.id) < key_of(b.id); });
}

json drifting_apart(int trials = 3) {
  json experiment = json::parse(R"({"name": "x", "dataset": {"type": "fake"}, "starts": {},
                                    "pipeline": [{"step": "drift"}, {"step": "behave"}]})");
  experiment["starts"]["trials"] = trials;
  return experiment;
}

Experiment experiment_of(const json& description) {
  const test::TempFolder folder;
  return load_experiment(folder.write("x.json", description.dump()), test::fake_catalogue());
}

/// Runs all trials.
void run_all(const Experiment& experiment, const std::vector<SceneGroup>& scenes, int jobs,
             const RunListener& listener) {
  const Selection selection{select_variants(experiment, {}), {}};
  run_trials(experiment, scenes, plan_trials(experiment, scenes, selection), jobs, listener);
}

Ran run(const json& description, int jobs = 2) {
  const Experiment experiment = experiment_of(description);
  const std::vector<SceneGroup> scenes = scene_groups(experiment, "");
  Ran ran;
  RunListener listener;
  const auto add_timings = [&](const std::vector<TimingRow>& rows) {
    ran.timings.insert(ran.timings.end(), rows.begin(), rows.end());
  };
  listener.on_scene = [](const std::string&) {};
  listener.on_trial = [&](const TrialRecord& record, const std::vector<TimingRow>& rows) {
    ran.records.push_back(record);
    add_timings(rows);
  };
  listener.on_scene_timings = add_timings;
  run_all(experiment, scenes, jobs, listener);
  sort_by_id(ran.records);
  return ran;
}

/// The bits of where a trial ended.
std::string bits(const TrialRecord& record) {
  const RigidTransform T = record.T_reference_sensor.value_or(RigidTransform{});
  std::string bytes(12 * sizeof(double), '\0');
  std::memcpy(bytes.data(), T.rotation.data(), 9 * sizeof(double));
  std::memcpy(bytes.data() + 9 * sizeof(double), T.translation.data(), 3 * sizeof(double));
  return bytes;
}

void expect_same(const TrialRecord& a, const TrialRecord& b) {
  EXPECT_EQ(key_of(a.id), key_of(b.id));
  EXPECT_EQ(bits(a), bits(b));
  EXPECT_EQ(a.status, b.status);
  ASSERT_EQ(a.steps.size(), b.steps.size());
  for (std::size_t i = 0; i < a.steps.size(); ++i)
    EXPECT_EQ(a.steps[i].diagnostics, b.steps[i].diagnostics);
}

TEST(Runner, SameBitsOnAnyNumberOfThreads) {
  for (const int scenes : {2, 60}) {
    json experiment = drifting_apart(scenes == 2 ? 20 : 1);
    experiment["dataset"]["scenes"] = scenes;
    const Ran one = run(experiment, 1);
    ASSERT_EQ(one.records.size(), scenes == 2 ? 2U * 2U * 20U : 60U * 2U);
    for (const int jobs : {2, 4, 7}) {
      const Ran other = run(experiment, jobs);
      ASSERT_EQ(other.records.size(), one.records.size());
      for (std::size_t i = 0; i < one.records.size(); ++i)
        expect_same(one.records[i], other.records[i]);
    }
  }
}

/// Counts clouds that are alive: each holds one of these.
class Counted {
 public:
  Counted(std::atomic<int>& alive, std::atomic<int>& most) : alive_(&alive) {
    const int now = ++alive;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
    }
  }
  ~Counted() { --*alive_; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  std::atomic<int>* alive_;
};

TEST(Runner, HoldsFewScenesAndTellsOneThingAtATime) {
  json description = drifting_apart(1);
  description["dataset"]["scenes"] = 80;
  const Experiment experiment = experiment_of(description);
  const std::vector<SceneGroup> scenes = scene_groups(experiment, "");
  for (const int jobs : {1, 2, 5}) {
    std::vector<std::string> begun;
    std::size_t ended = 0, most_at_a_time = 0;
    int records = 0;
    std::atomic<int> inside{0}, most_inside{0};
    RunListener listener;
    listener.on_scene = [&](const std::string& scene) {
      const Counted told(inside, most_inside);
      begun.push_back(scene);
      most_at_a_time = std::max(most_at_a_time, begun.size() - ended);
    };
    listener.on_trial = [&](const TrialRecord&, const std::vector<TimingRow>&) {
      const Counted told(inside, most_inside);
      ++records;
    };
    listener.on_scene_timings = [&](const std::vector<TimingRow>&) {
      const Counted told(inside, most_inside);
      ++ended;
    };
    run_all(experiment, scenes, jobs, listener);
    EXPECT_EQ(records, 80 * 2);
    EXPECT_EQ(ended, 80U);
    EXPECT_EQ(std::set<std::string>(begun.begin(), begun.end()).size(), 80U);
    EXPECT_EQ(most_inside, 1);
    EXPECT_LE(most_at_a_time, static_cast<std::size_t>(jobs) + 1);
  }
}

TEST(Runner, AddingAVariantASceneOrASensorChangesNoNumber) {
  const Ran few = run(drifting_apart());
  json more = drifting_apart(5);
  more["variants"] = json::parse(R"([{"name": "more", "replace": {"drift.size_m": 1}}])");
  more["dataset"]["sensors"] = 3;
  const Ran many = run(more);
  std::size_t found = 0;
  for (const TrialRecord& record : few.records) {
    for (const TrialRecord& other : many.records) {
      if (key_of(other.id) != key_of(record.id)) continue;
      ++found;
      // The fake truth of a sensor depends on how many there are; draws do not.
      EXPECT_EQ(record.steps[0].diagnostics[1], other.steps[0].diagnostics[1]);
    }
  }
  EXPECT_EQ(found, few.records.size());
}

TEST(Runner, TrialsOfVariantsArePaired) {
  json two = drifting_apart();
  two["variants"] =
      json::parse(R"([{"name": "same", "replace": {"drift.search": {"type": "fine"}}}])");
  const Ran both = run(two);
  const std::size_t half = both.records.size() / 2;
  for (std::size_t i = 0; i < half; ++i)
    EXPECT_EQ(bits(both.records[i]), bits(both.records[half + i]));
  EXPECT_NE(bits(both.records[0]), bits(both.records[1]));
}

/// A base and three variants that share the first step, all three steps but one, and nothing.
json branching() {
  json description = drifting_apart(4);
  description["pipeline"] = json::parse(R"([{"step": "drift"}, {"step": "drift", "name": "second"},
                                            {"step": "behave"}])");
  description["variants"] = json::parse(R"([
      {"name": "late", "replace": {"behave.how": "reject"}},
      {"name": "middle", "replace": {"second.size_m": 1}},
      {"name": "defeat", "replace": {"second": {"step": "behave", "how": "defeat"}}},
      {"name": "early", "replace": {"drift.size_m": 1}}])");
  return description;
}

TEST(Runner, SharedStepsComeToTheBitsOfStepsOfTheirOwn) {
  const Experiment experiment = experiment_of(branching());
  const std::vector<SceneGroup> scenes = scene_groups(experiment, "");
  const std::vector<TrialRecord> shared = run(branching()).records;
  std::vector<TrialRecord> alone;
  RunListener listener;
  listener.on_scene = [](const std::string&) {};
  listener.on_trial = [&](const TrialRecord& record, const std::vector<TimingRow>&) {
    alone.push_back(record);
  };
  listener.on_scene_timings = [](const std::vector<TimingRow>&) {};
  for (std::size_t variant = 0; variant < experiment.variants.size(); ++variant) {
    run_trials(experiment, scenes, plan_trials(experiment, scenes, {{variant}, {}}), 2, listener);
  }
  sort_by_id(alone);
  ASSERT_EQ(alone.size(), shared.size());
  for (std::size_t i = 0; i < alone.size(); ++i) expect_same(alone[i], shared[i]);
}

TEST(Runner, ASharedStepRunsOnceAndItsTimeIsBookedToEachVariant) {
  const Ran ran = run(branching());
  std::map<std::string, std::set<double>> seconds;  // Of each start and step.
  std::map<std::string, int> rows;
  for (const TimingRow& row : ran.timings) {
    if (row.id.trial < 0) continue;
    const std::string start = row.id.scene + row.id.sensor + std::to_string(row.id.trial);
    if (row.step != "drift" || row.id.variant == "early") continue;
    seconds[start].insert(row.seconds);
    ++rows[start];
  }
  EXPECT_EQ(rows.size(), 2U * 2U * 4U);
  for (const auto& [start, count] : rows) {
    EXPECT_EQ(count, 4) << start;
    EXPECT_EQ(seconds[start].size(), 1U) << start;
  }
}

TEST(Runner, EndsWhereMemoryDoesAndRecordsNothing) {
  json experiment = drifting_apart();
  experiment["pipeline"][1]["how"] = "memory";
  EXPECT_THROW(run(experiment), std::bad_alloc);
}

TEST(Runner, SaysHowATrialEnded) {
  struct Case {
    const char* how;
    Status status;
    const char* reason;
    bool has_pose;
  };
  for (const Case& c :
       {Case{"pass", Status::inaccurate, "", true},
        Case{"reject", Status::rejected, "behave: too few points", true},
        Case{"defeat", Status::failed, "behave: no ground", false},
        Case{"nan", Status::failed, "the pose is not finite", false},
        Case{"far", Status::failed, "the distance of the pose exceeds 1000000000 m", false},
        Case{"misjudge", Status::failed,
             "invalid covariance: not symmetric, finite and positive semi-definite", false},
        Case{"skewed", Status::failed,
             "the rotation of the pose is invalid: the columns of its matrix are not orthonormal",
             false}}) {
    json experiment = drifting_apart();
    experiment["pipeline"][1]["how"] = c.how;
    for (const TrialRecord& record : run(experiment).records) {
      EXPECT_EQ(record.status, c.status) << c.how;
      EXPECT_EQ(record.reason, c.reason);
      EXPECT_EQ(record.T_reference_sensor.has_value(), c.has_pose);
      EXPECT_EQ(record.error.has_value(), c.has_pose);
      EXPECT_EQ(record.steps.size(), 2U);
    }
  }
}

TEST(Runner, ABugEndsTheRun) {
  for (const int scenes : {2, 50}) {
    json experiment = drifting_apart();
    experiment["dataset"]["scenes"] = scenes;
    experiment["pipeline"][1]["how"] = "bug";
    for (const int jobs : {1, 4}) EXPECT_THROW(run(experiment, jobs), std::logic_error);
  }
}

TEST(Runner, ABugInOneSceneLeavesNoScanHalfDone) {
  json description = drifting_apart(2);
  description["dataset"]["scenes"] = 50;
  const Experiment experiment = experiment_of(description);
  std::vector<SceneGroup> scenes = scene_groups(experiment, "");
  scenes[9].scenes[0].sensors[0].load = []() -> LoadedCloud { throw std::logic_error("a bug"); };
  std::vector<TrialRecord> records;
  RunListener listener;
  listener.on_scene = [](const std::string&) {};
  listener.on_trial = [&](const TrialRecord& record, const std::vector<TimingRow>&) {
    records.push_back(record);
  };
  listener.on_scene_timings = [](const std::vector<TimingRow>&) {};
  EXPECT_THROW(run_all(experiment, scenes, 4, listener), std::logic_error);
  for (const TrialRecord& record : records) {
    EXPECT_NE(record.status, Status::failed) << record.reason;
    EXPECT_NE(record.id.scene, scenes[9].name);
  }
}

TEST(Runner, SuccessIsWithinTheBounds) {
  json experiment = drifting_apart();
  experiment["starts"] = {{"rotation_deg", 0}, {"translation_m", 0}, {"trials", 30}};
  experiment["success"] = {{"rotation_deg", 0.0001}, {"translation_m", 0.015}};
  int successes = 0;
  for (const TrialRecord& record : run(experiment).records) {
    const bool is_within = record.error->translation_m <= 0.015;
    EXPECT_EQ(record.status, is_within ? Status::success : Status::inaccurate);
    successes += is_within;
  }
  EXPECT_GT(successes, 0);
  EXPECT_LT(successes, 120);
}

TEST(Runner, WithoutTruthATrialIsFinished) {
  json experiment = drifting_apart();
  experiment["dataset"]["truth"] = false;
  experiment["starts"]["around"] = "nominal";
  for (const TrialRecord& record : run(experiment).records) {
    EXPECT_EQ(record.status, Status::finished);
    EXPECT_FALSE(record.error.has_value());
    EXPECT_TRUE(record.T_reference_sensor.has_value());
  }
}

TEST(Runner, WithoutAnInitialGuessATrialStartsAtTheIdentity) {
  json experiment = drifting_apart();
  experiment["dataset"]["truth"] = false;
  experiment["starts"] = "none";
  experiment["pipeline"] = json::parse(R"([{"step": "behave"}])");
  const std::vector<TrialRecord> records = run(experiment).records;
  EXPECT_EQ(records.size(), 2U * 2U);
  for (const TrialRecord& record : records) {
    EXPECT_EQ(record.status, Status::finished);
    EXPECT_EQ(record.T_reference_sensor->rotation, Eigen::Matrix3d::Identity());
    EXPECT_EQ(record.T_reference_sensor->translation, Eigen::Vector3d::Zero());
  }
}

TEST(Runner, AnUnreadableCloudFailsItsTrialsAlone) {
  json experiment = drifting_apart();
  experiment["dataset"]["unreadable"] = 1;  // s0
  for (const TrialRecord& record : run(experiment).records) {
    const bool is_bad = record.id.sensor == "s0";
    EXPECT_EQ(record.status == Status::failed, is_bad);
    EXPECT_EQ(record.reason, is_bad ? "the cloud of s0: byte 7: expected points" : "");
  }
}

TEST(Runner, AnUnreadableReferenceFailsTheScene) {
  json experiment = drifting_apart();
  experiment["dataset"]["unreadable"] = -2;
  for (const TrialRecord& record : run(experiment).records) {
    EXPECT_EQ(record.status, Status::failed);
    EXPECT_EQ(record.reason, "the cloud of top: byte 7: expected points");
  }
}

TEST(Runner, AnEmptyCloudFails) {
  json experiment = drifting_apart();
  experiment["dataset"]["points"] = 0;
  for (const TrialRecord& record : run(experiment).records) {
    EXPECT_EQ(record.reason, "the cloud of top: it has no points");
  }
}

TEST(Runner, TimesStepsPerTrialAndSharedWorkPerScene) {
  const Ran timed = run(drifting_apart());
  int steps = 0, readings = 0, shared = 0;
  for (const TimingRow& row : timed.timings) {
    EXPECT_EQ(row.id.variant.empty(), row.id.trial == -1);
    if (row.id.trial >= 0) {
      ++steps;
    } else if (row.step == "reading") {
      ++readings;
    } else {
      ++shared;
      EXPECT_EQ(row.step, "drift");
    }
  }
  EXPECT_EQ(steps, 2 * 2 * 3 * 2);
  EXPECT_EQ(readings, 2 * 3);
  EXPECT_EQ(shared, 2 * 2);
}

}  // namespace
}  // namespace croon::experiments

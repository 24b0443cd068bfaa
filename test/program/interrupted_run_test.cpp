// The program as a user runs it: killed and started again, cut into shards, on one thread and on
// many. The results are the bytes of one undisturbed run.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/store/store.hpp"
#include "framework/base/rng.hpp"
#include "framework/base/whole_file.hpp"
#include "test/program/killed_program.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

// Three small sensors: a run is short, and kills fall into all of its parts.
constexpr const char* kRig = R"({
  "reference": "top", "reference_height_m": 1.9, "sensors": {
    "top": {"model": {"like": "spinner_16", "azimuth_step_deg": 0.6}},
    "left": {"model": {"like": "spinner_16", "azimuth_step_deg": 0.6}, "translation_m": [0, 0.8, -0.3]},
    "right": {"model": {"like": "spinner_16", "azimuth_step_deg": 0.6}, "translation_m": [0, -0.8, -0.3]}}
})";

// RIG is for kRig.
constexpr const char* kInterrupted = R"({
  "name": "small",
  "dataset": {"type": "simulated", "rig": RIG, "scenes": 4},
  "starts": {"rotation_deg": 10, "translation_m": 0.1, "trials": 3},
  "success": {"rotation_deg": 5, "translation_m": 0.5},
  "pipeline": [
    {"step": "preprocessing", "sensor": [{"type": "voxel_downsample", "leaf_size_m": 0.5}]},
    {"step": "ground_alignment"},
    {"step": "planar_alignment"},
    {"step": "covariance"}
  ],
  "variants": [
    {"name": "coarse", "replace": {"preprocessing.sensor": [{"type": "voxel_downsample", "leaf_size_m": 2}]}},
    {"name": "ground alone", "remove": ["planar_alignment"]}
  ]
})";

// Groups of three scenes, and a step that sees all of their sensors and pairs of sensors at once.
constexpr const char* kRigExperiment = R"({
  "name": "rigs",
  "dataset": {"type": "simulated", "rig": RIG, "scenes": 7},
  "scenes_per_trial": 3,
  "loops": true,
  "starts": {"rotation_deg": 5, "translation_m": 0.1, "trials": 2},
  "success": {"rotation_deg": 5, "translation_m": 0.5},
  "pipeline": [
    {"step": "preprocessing", "sensor": [{"type": "voxel_downsample", "leaf_size_m": 1}]},
    {"step": "planar_alignment", "points": "all"},
    {"step": "covariance"},
    {"step": "consensus", "max_rotation_deg": 5, "max_translation_m": 0.3},
    {"step": "registration", "icp": {"type": "point_to_point", "max_iterations": 2}}
  ],
  "variants": [{"name": "one scene", "remove": ["consensus"]}, {"name": "covariance", "remove": ["registration"]}]
})";

struct Case {
  const char* name;
  const char* experiment;
  std::size_t trials;
  int shards;
};

constexpr Case kCases[] = {
    {"Pairs", kInterrupted, 3 * 4 * 2 * 3, 4},   // Variants, scenes, sensors, starts.
    {"Rigs", kRigExperiment, 3 * 2 * 3 * 2, 3},  // Variants, groups, sensors and pairs, starts.
};
constexpr int kKills = 8;

/// The words of `text` between the `separator`s.
std::vector<std::string> split(const std::string& text, char separator) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

class InterruptedRun : public testing::TestWithParam<Case> {
 protected:
  InterruptedRun() {
    std::string experiment = GetParam().experiment;
    experiment.replace(experiment.find("RIG"), 3, kRig);
    folder_.write("small.json", experiment);
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }

  std::vector<std::string> words(const std::string& out) const {
    return {"run", path("small.json").string(), "--out", path(out).string(), "--quiet"};
  }

  void run(const std::string& out, const std::string& options = "") const {
    std::string arguments;
    for (const std::string& word : words(out)) arguments += "\"" + word + "\" ";
    expect_done(arguments + options);
  }

  static void expect_done(const std::string& arguments) {
    const Answer answer = croon(arguments);
    ASSERT_EQ(answer.code, 0) << arguments << "\n" << answer.text;
  }

  void expect_same_results(const std::string& out) const {
    for (const char* file :
         {"trials.csv", "covariance.csv", "summary.csv", "summary.json", "summary_by_kind.csv"}) {
      EXPECT_TRUE(read_whole_file(path(out) / file) == read_whole_file(path("whole") / file))
          << out << "/" << file;
    }
  }

  test::TempFolder folder_;
};

/// Each of `trials` trials is in the table and in the store, once.
void expect_each_trial_once(const fs::path& folder, std::size_t trials) {
  std::map<std::string, int> times;
  for (const std::string& row : split(read_whole_file(folder / "trials.csv"), '\n')) {
    const std::vector<std::string> cells = split(row, ',');
    ASSERT_GE(cells.size(), 4U) << row;
    ++times[cells[0] + "," + cells[1] + "," + cells[2] + "," + cells[3]];
  }
  EXPECT_EQ(times.erase("variant,scene,sensor,trial"), 1U);
  EXPECT_EQ(times.size(), trials);
  for (const auto& [trial, count] : times) EXPECT_EQ(count, 1) << trial;
  const Database store(folder / "store.sqlite", Access::read);
  Statement count = store.prepare("SELECT COUNT(*) FROM trials");
  ASSERT_TRUE(count.next());
  EXPECT_EQ(count.integer(0), static_cast<std::int64_t>(trials));
}

/// A header, then whole rows that end in seconds.
void expect_well_formed_timings(const fs::path& file) {
  const std::string text = read_whole_file(file);
  ASSERT_FALSE(text.empty());
  EXPECT_EQ(text.back(), '\n');
  std::vector<std::string> rows = split(text, '\n');
  EXPECT_EQ(rows.front(), "variant,scene,sensor,trial,step,seconds");
  rows.erase(rows.begin());
  EXPECT_FALSE(rows.empty());
  for (const std::string& row : rows) {
    const std::vector<std::string> cells = split(row, ',');
    ASSERT_EQ(cells.size(), 6U) << row;
    std::size_t length = 0;
    EXPECT_GE(std::stod(cells[5], &length), 0.0) << row;
    EXPECT_EQ(length, cells[5].size()) << row;
  }
}

TEST_P(InterruptedRun, GoesOnAfterKillsAtAnyMoment) {
  const auto begin = std::chrono::steady_clock::now();
  run("whole");
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
  expect_each_trial_once(path("whole"), GetParam().trials);
  Rng rng(StreamKey(1).with("kills"));
  // A folder is finished in ever shorter runs: kills fall into reading, trials and reports. Then
  // comes a new folder, as long as there are kills to make.
  int kills = 0;
  for (int folder = 0; kills < kKills; ++folder) {
    const std::string out = std::to_string(folder);
    while (kills < kKills && kill_croon_after(rng.uniform(0, duration.count()), words(out))) {
      ++kills;
    }
    run(out);
    expect_same_results(out);
    expect_each_trial_once(path(out), GetParam().trials);
    expect_well_formed_timings(path(out) / "timings.csv");
  }
}

TEST_P(InterruptedRun, IsTheSameBytesOnFourThreadsAndFromShardsOnOne) {
  run("whole", "--jobs 4");
  std::string merge = "merge";
  const std::string shards = std::to_string(GetParam().shards);
  for (int shard = 1; shard <= GetParam().shards; ++shard) {
    const std::string out = "shard." + std::to_string(shard);
    run(out, "--jobs 1 --shard " + std::to_string(shard) + "/" + shards);
    EXPECT_FALSE(read_whole_file(path(out) / "trials.csv") ==
                 read_whole_file(path("whole/trials.csv")));
    merge += " \"" + path(out).string() + "\"";
  }
  expect_done(merge + " --out \"" + path("merged").string() + "\"");
  expect_same_results("merged");
  expect_each_trial_once(path("merged"), GetParam().trials);
}

INSTANTIATE_TEST_SUITE_P(All, InterruptedRun, testing::ValuesIn(kCases),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace croon::experiments

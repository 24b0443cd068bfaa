// Starts that were written run to the same results as those that are drawn.
#include <gtest/gtest.h>

#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

std::string experiment_with(const std::string& starts) {
  return R"({"name": "x", "dataset": {"type": "simulated", "rig": "croon_three", "scenes": 2},
             "pipeline": [{"step": "ground_alignment"}], "starts": )" +
         starts + "}";
}

class StartsCommand : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  void run(const std::string& arguments) const {
    const Answer answer = croon(arguments);
    EXPECT_EQ(answer.code, 0) << arguments << "\n" << answer.text;
  }
  void expect_same_trials(const std::string& starts) const {
    folder_.write("drawn.json", experiment_with(starts));
    folder_.write("read.json", experiment_with(R"({"file": "starts.csv"})"));
    run("starts " + path("drawn.json") + " --out " + path("starts.csv"));
    run("run " + path("drawn.json") + " --out " + path("drawn") + " --quiet");
    run("run " + path("read.json") + " --out " + path("read") + " --quiet");
    EXPECT_EQ(read_whole_file(path("drawn/trials.csv")), read_whole_file(path("read/trials.csv")));
    // What was read is written as it was.
    EXPECT_EQ(croon("starts " + path("read.json")).text, read_whole_file(path("starts.csv")));
  }

  test::TempFolder folder_;
};

TEST_F(StartsCommand, WritesWhatARunDraws) {
  expect_same_trials(R"({"rotation_deg": 180, "translation_m": 0.3, "trials": 6})");
}

TEST_F(StartsCommand, WritesWhatASweepDraws) {
  expect_same_trials(R"({"sweep": {"rotation_deg": [0, 20], "levels": 3}, "trials": 2})");
}

TEST_F(StartsCommand, RefusesAnExperimentWithoutStarts) {
  folder_.write("x.json", experiment_with(R"("none")"));
  run("validate " + path("x.json"));
  const Answer answer = croon("starts " + path("x.json"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("x.json: /starts: expected starts that are drawn or listed, found "
                             "\"none\": each trial starts at the identity"),
            std::string::npos)
      << answer.text;
}

TEST_F(StartsCommand, IsReadBelowTheDataRootFirst) {
  folder_.write("x.json", experiment_with(R"({"trials": 1})"));
  folder_.write("read.json", experiment_with(R"({"file": "starts.csv"})"));
  run("starts " + path("x.json") + " --out " + path("starts.csv"));
  folder_.write("data/starts.csv", "not starts\n");
  run("starts " + path("read.json"));
  const Answer answer = croon("starts " + path("read.json") + " --data " + path("data"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("data/starts.csv: line 1: expected \"scene,sensor,trial"),
            std::string::npos)
      << answer.text;
}

TEST_F(StartsCommand, RefusesMoreTrialsThanTheFileHas) {
  folder_.write("x.json", experiment_with(R"({"trials": 2})"));
  run("starts " + path("x.json") + " --out " + path("starts.csv"));
  folder_.write("read.json", experiment_with(R"({"file": "starts.csv", "trials": 3})"));
  const Answer answer = croon("starts " + path("read.json"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("/starts/trials: expected at most 2 trials, as many as "),
            std::string::npos)
      << answer.text;
  run("starts " + path("read.json") + " --trials 1");
}

TEST_F(StartsCommand, NamesTheFileThatIsNotThere) {
  folder_.write("x.json", experiment_with(R"({"file": "none.csv"})"));
  run("validate " + path("x.json"));
  const Answer answer = croon("run " + path("x.json") + " --out " + path("out"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("/starts/file: expected a file of starts, found neither "),
            std::string::npos)
      << answer.text;
}

TEST_F(StartsCommand, OverwritesNeitherWhatItReadsNorAStore) {
  folder_.write("x.json", experiment_with(R"({"trials": 2})"));
  folder_.write("run/store.sqlite", "trials");
  for (const char* out : {"x.json", "run/store.sqlite"}) {
    const std::string before = read_whole_file(path(out));
    const Answer answer = croon("starts " + path("x.json") + " --out " + path(out));
    EXPECT_EQ(answer.code, 2);
    EXPECT_EQ(answer.text.find("croon: --out: expected a file to write, found "), 0U)
        << answer.text;
    EXPECT_EQ(read_whole_file(path(out)), before);
  }
}

TEST_F(StartsCommand, OverwritesNoFileThatItsExperimentConsistsOf) {
  folder_.write("bases/base.json", experiment_with(R"({"trials": 2})"));
  folder_.write("x.json", R"({"extends": "bases/base.json"})");
  run("starts " + path("x.json") + " --out " + path("starts.csv"));
  folder_.write("read.json", R"({"extends": "bases/base.json", "starts": {"file": "starts.csv"},
                                 "variants": [{"name": "other", "poses": "poses.csv"}]})");
  std::filesystem::copy(path("starts.csv"), path("poses.csv"));
  for (const char* out : {"read.json", "bases/base.json", "starts.csv", "poses.csv"}) {
    const std::string before = read_whole_file(path(out));
    const Answer answer = croon("starts " + path("read.json") + " --trials 1 --out " + path(out));
    EXPECT_EQ(answer.code, 2);
    EXPECT_NE(answer.text.find(std::string(out) + ", which is read"), std::string::npos)
        << answer.text;
    EXPECT_EQ(read_whole_file(path(out)), before);
  }
}

TEST_F(StartsCommand, IsEstimatedBeforeItIsMade) {
  folder_.write("x.json", R"({"name": "x", "dataset": {"type": "simulated", "scenes": 10000},
                "starts": {"trials": 1000000}, "pipeline": [{"step": "identity"}]})");
  const Answer answer = croon("starts " + path("x.json") + " --out " + path("starts.csv"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_NE(answer.text.find("x.json: a list of 40000000000 starts takes about "),
            std::string::npos)
      << answer.text;
  EXPECT_FALSE(std::filesystem::exists(path("starts.csv")));
}

TEST_F(StartsCommand, AreWrittenBesideSimulatedScenes) {
  folder_.write("x.json", experiment_with(R"({"rotation_deg": 10, "trials": 2})"));
  run("starts " + path("x.json") + " --out " + path("mine.csv"));
  folder_.write("read.json", experiment_with(R"({"file": "mine.csv"})"));
  run("simulate " + path("read.json") + " --out " + path("data") + " --quiet");
  EXPECT_EQ(read_whole_file(path("mine.csv")), read_whole_file(path("data/starts.csv")));
  run("starts " + path("data/experiment.json") + " --data " + path("data"));
}

}  // namespace
}  // namespace croon::experiments

// `--out` of a command that writes files of its own, beside no results.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "experiments/run/given_velocities.hpp"
#include "experiments/run/pose_file.hpp"
#include "framework/base/whole_file.hpp"
#include "test/program/program.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOneScene = R"({"name": "x",
    "dataset": {"type": "simulated", "rig": "croon_three", "scenes": 1, "mix": {"empty": 1}},
    "starts": {"rotation_deg": 1, "trials": 1},
    "pipeline": [{"step": "identity"}]})";

class OutputFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("x.json", kOneScene);
    ASSERT_EQ(croon("simulate " + path("x.json") + " --quiet --out " + path("data")).code, 0);
    ASSERT_EQ(croon("run " + path("data/experiment.json") + " --data " + path("data") +
                    " --quiet --out " + path("results"))
                  .code,
              0);
  }

  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  /// A command that writes the file `out`.
  std::map<std::string, std::string> commands(const std::string& out) const {
    const std::string results = path("results");
    return {{"table", "export " + results + " --format csv --out " + out},
            {"figure", "export " + results + " --figure box_plots --format svg --out " + out},
            {"starts", "starts " + path("x.json") + " --out " + out}};
  }

  void expect_refused(const std::string& command, const std::string& file,
                      const std::string& what) const {
    const std::string before = read_whole_file(file);
    const Answer answer = croon(command);
    EXPECT_EQ(answer.code, 2) << command;
    EXPECT_NE(answer.text.find("croon: --out: expected a "), std::string::npos) << answer.text;
    EXPECT_NE(answer.text.find("found " + file + ", " + what + "\n"), std::string::npos)
        << answer.text;
    EXPECT_EQ(read_whole_file(file), before);
  }

  test::TempFolder folder_;
};

TEST_F(OutputFile, IsWrittenAndReplacesAnEarlierOne) {
  for (const auto& [name, command] : commands(path("new"))) {
    EXPECT_EQ(croon(command).code, 0) << name;
    const std::string bytes = read_whole_file(path("new"));
    EXPECT_FALSE(bytes.empty()) << name;
    EXPECT_EQ(croon(command).code, 0) << name << ", the same again";
    EXPECT_EQ(read_whole_file(path("new")), bytes) << name;
    folder_.write("new", "an earlier table");
    EXPECT_EQ(croon(command).code, 0) << name;
    EXPECT_EQ(read_whole_file(path("new")), bytes) << name;
    fs::remove(path("new"));
  }
}

TEST_F(OutputFile, OfAllFiguresIsAFolder) {
  const std::string command = "export " + path("results") + " --figure all";
  EXPECT_EQ(croon(command).code, 2);
  const Answer answer = croon(command + " --out " + path("papers/figures"));
  EXPECT_EQ(answer.code, 0) << answer.text;
  for (const char* figure : {"box_plots", "kinds", "success_curve", "times"}) {
    for (const char* ending : {"_one_column.pdf", "_one_column.svg", "_two_columns.pdf"}) {
      const std::string file = path("papers/figures/") + figure + ending;
      EXPECT_TRUE(fs::exists(file)) << file;
      EXPECT_NE(answer.text.find(file + "\n"), std::string::npos) << answer.text;
    }
  }
  EXPECT_NE(answer.text.find("no basin: needs a sweep of starts and ground truth\n"),
            std::string::npos);
  EXPECT_EQ(croon(command + " --format svg --width screen --out " + path("screen")).code, 0);
  EXPECT_EQ(std::distance(fs::directory_iterator(path("screen")), {}), 4);
}

TEST_F(OutputFile, OfATableHasEachFolderOnce) {
  const std::string results = path("results");
  const Answer answer = croon("export " + results + " " + path("data/../results"));
  EXPECT_EQ(answer.code, 2);
  EXPECT_EQ(answer.text, "croon: " + path("data/../results") +
                             ": expected each folder once, found this one twice\n");
}

TEST_F(OutputFile, ReplacesNeitherInputsNorResultsNorData) {
  const std::pair<const char*, const char*> files[] = {
      {"x.json", ""},
      {"data/truth.json", "a file of a dataset"},
      {"data/scene_kinds.json", "a file of a dataset"},
      {"data/experiment.json", "an experiment"},
      {"data/000000/top.pcd", "a cloud"},
      {"results/store.sqlite", "a file of the results of a run"},
      {"results/manifest.json", "a file of the results of a run"},
      {"results/timings.sqlite", "a file of the results of a run"},
      {"results/trials.csv", "a file of the results of a run"}};
  for (const auto& [file, what] : files) {
    const std::string there = path(file);
    for (const auto& [name, command] : commands(there)) {
      const std::string is_input = name == "starts" ? "which is read" : "an experiment";
      expect_refused(command, there, *what == '\0' ? is_input : what);
    }
  }
}

TEST_F(OutputFile, ReplacesNoFileThatExperimentsName) {
  const std::string starts = path("starts.csv");
  ASSERT_EQ(croon("starts " + path("x.json") + " --out " + starts).code, 0);
  folder_.write("velocities.csv", std::string("\xef\xbb\xbf") + velocity_header() + "\n");
  folder_.write("poses.csv", std::string(kPoseHeader) + "\n");
  folder_.write("part.json", R"({"pipeline": []})");
  const std::pair<const char*, const char*> files[] = {{"starts.csv", "a file of starts"},
                                                       {"velocities.csv", "a file of velocities"},
                                                       {"poses.csv", "a file of poses"},
                                                       {"part.json", "an experiment"}};
  for (const auto& [file, what] : files) {
    for (const auto& [name, command] : commands(path(file))) {
      if (name == "starts" && path(file) == starts) continue;
      expect_refused(command, path(file), what);
    }
  }
  // A list of starts is made again.
  EXPECT_EQ(croon("starts " + path("x.json") + " --trials 2 --out " + starts).code, 0);
}

TEST_F(OutputFile, IsNoFileThatAStoreWouldTakeForItsOwn) {
  const std::string log = path("results/store.sqlite-wal");
  ASSERT_FALSE(fs::exists(log));
  for (const auto& [name, command] : commands(log)) {
    const Answer answer = croon(command);
    EXPECT_EQ(answer.code, 2) << name;
    EXPECT_NE(answer.text.find("a file of the results of a run"), std::string::npos) << answer.text;
    EXPECT_FALSE(fs::exists(log)) << name;
  }
}

TEST_F(OutputFile, IsNotWrittenThroughALinkOrOverAFolder) {
  fs::create_symlink("missing", path("link"));
  for (const char* file : {"link", "data"}) {
    for (const auto& [name, command] : commands(path(file))) {
      EXPECT_EQ(croon(command).code, 2) << name;
    }
  }
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_FALSE(fs::exists(path("missing")));
}

TEST_F(OutputFile, OfSimulatedScenesThatAUserHasChangedStays) {
  for (const char* name : {"data/truth.json", "data/scene_kinds.json", "data/experiment.json"}) {
    const std::string before = read_whole_file(path(name));
    folder_.write(name, "mine");
    expect_refused("simulate " + path("x.json") + " --quiet --out " + path("data"), path(name),
                   "which exists; delete it first, or write to another file");
    folder_.write(name, before);
  }
}

}  // namespace
}  // namespace croon::experiments

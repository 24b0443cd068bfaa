#include "experiments/cli/commands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/store/database.hpp"
#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

json two_variants() {
  return json::parse(R"({"name": "x", "dataset": {"type": "fake"}, "starts": {"trials": 5},
                         "pipeline": [{"step": "drift"}],
                         "variants": [{"name": "far", "replace": {"drift.size_m": 2}}]})");
}

class MergeCommand : public testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_.path() / name; }

  /// Runs a shard, "" for all, of `experiment` into the folder `out`.
  void run(const std::string& out, const std::string& shard, const json& experiment) const {
    RunOptions options;
    options.experiment = folder_.write(out + ".json", experiment.dump());
    options.out = path(out);
    options.shard = shard;
    options.only = only_;
    options.quiet = true;
    std::ostringstream text, progress;
    run_command(options, test::fake_catalogue(), text, progress);
  }

  int merge(const std::vector<std::string>& from, const std::string& out) {
    MergeOptions options;
    for (const std::string& name : from) options.folders.push_back(path(name));
    options.out = path(out);
    options.same_build = same_build_;
    std::ostringstream text;
    const int code = merge_command(options, text);
    text_ = text.str();
    return code;
  }

  /// As if another build had made the trials of `name`.
  void change_build(const std::string& name) const {
    Database(path(name) / "store.sqlite", Access::write)
        .run(
            "UPDATE meta SET value = replace(value, '\"program_sha256\":\"', "
            "'\"program_sha256\":\"0') WHERE name = 'builds'");
  }

  std::string fault(const std::vector<std::string>& from, const std::string& out) {
    return test::input_error([&] { merge(from, out); });
  }

  void expect_whole(const std::string& out) const {
    for (const char* file : {"trials.csv", "summary.csv", "summary.json", "comparison.csv"}) {
      EXPECT_EQ(read_whole_file(path(out) / file), read_whole_file(path("whole") / file)) << file;
    }
  }

  test::TempFolder folder_;
  std::vector<std::string> only_;
  bool same_build_ = false;
  std::string text_;
};

TEST_F(MergeCommand, MakesOneRunOfShards) {
  run("whole", "", two_variants());
  for (const char* part : {"1", "2", "3"}) {
    run(part, std::string(part) + "/3", two_variants());
  }
  EXPECT_EQ(merge({"3", "1", "2"}, "merged"), 0);
  expect_whole("merged");
  EXPECT_EQ(text_.find("missing"), std::string::npos) << text_;
}

TEST_F(MergeCommand, OfOneBuildNamesTheOtherBuildAndFirstTheOtherExperiment) {
  run("1", "1/2", two_variants());
  run("2", "2/2", two_variants());
  json other = two_variants();
  other["seed"] = 2;
  run("other", "", other);
  change_build("2");
  change_build("other");
  EXPECT_EQ(merge({"1", "2"}, "merged"), 0);
  same_build_ = true;
  const std::string build = fault({"1", "2"}, "strict");
  EXPECT_NE(build.find((path("2") / "store.sqlite").string()), std::string::npos) << build;
  EXPECT_NE(build.find("were made by another build"), std::string::npos) << build;
  EXPECT_NE(fault({"1", "other"}, "strict").find("from different inputs: /seed was"),
            std::string::npos);
  // The folder that is merged into counts too.
  EXPECT_NE(fault({"1"}, "merged").find("were made by another build"), std::string::npos);
  EXPECT_EQ(merge({"1"}, "alone"), 3);
}

TEST_F(MergeCommand, ReadsAllBeforeItWrites) {
  run("1", "1/2", two_variants());
  run("2", "2/2", two_variants());
  for (const char* file : {"manifest.json", "timings.sqlite"}) {
    fs::rename(path("1") / file, path("kept"));
    fs::create_directory(path("1") / file);
    EXPECT_NE(fault({"1", "2"}, "merged").find(file), std::string::npos);
    EXPECT_FALSE(fs::exists(path("merged"))) << file;
    fs::remove(path("1") / file);
    fs::create_symlink("nowhere", path("1") / file);
    EXPECT_NE(fault({"1", "2"}, "merged").find(file), std::string::npos);
    EXPECT_FALSE(fs::exists(path("merged"))) << file;
    fs::remove(path("1") / file);
    fs::rename(path("kept"), path("1") / file);
  }
  EXPECT_EQ(merge({"1", "2"}, "merged"), 0);
}

TEST_F(MergeCommand, RefusesADamagedManifest) {
  run("1", "1/2", two_variants());
  run("2", "2/2", two_variants());
  const std::string file = (path("1") / "manifest.json").string();
  const std::string good = read_whole_file(file);
  for (const std::string& bad :
       {std::string(), std::string("{}"), std::string(R"({"host": 7})"),
        std::string(R"({"host": {"merged": {}}})"), good.substr(0, good.size() / 2)}) {
    write_whole_file(file, bad);
    EXPECT_EQ(fault({"2", "1"}, "merged").rfind(file + ": is damaged: ", 0), 0U) << bad;
    EXPECT_FALSE(fs::exists(path("merged"))) << bad;
  }
  // One that a killed run has not written yet is not missed.
  fs::remove(file);
  EXPECT_EQ(merge({"1", "2"}, "merged"), 0);
}

TEST_F(MergeCommand, TakesEachWallTimeOnceAndNoneThatIsMalicious) {
  run("1", "", two_variants());
  const std::string good = read_whole_file(path("1/timings.csv"));
  Database(path("1/timings.sqlite"), Access::write)
      .run(
          "INSERT INTO timings VALUES('base', 'z', 'l', 0, 0, '=1+1', 1.0), "
          "('base' || char(27), 'z', 'l', 0, 0, 'x', 1.0), ('far', 'z', 'l', 0, 0, 'a, b', 0.5)");
  merge({"1"}, "merged");
  EXPECT_EQ(read_whole_file(path("merged/timings.csv")), good + "far,z,l,0,\"a, b\",0.5\n");
  // A merge into one of the folders, and one that is repeated.
  for (const char* out : {"merged", "1"}) {
    merge({"1", "merged"}, out);
    EXPECT_EQ(read_whole_file(path(out) / "timings.csv"), good + "far,z,l,0,\"a, b\",0.5\n");
  }
}

TEST_F(MergeCommand, LeavesNothingOfAKilledOne) {
  run("1", "", two_variants());
  const auto leave = [&](const std::string& out) {
    for (const char* ending : {"", "-wal", "-shm", ".new"}) {
      folder_.write(out + "/store.sqlite.merged" + ending, std::string(100, '\0'));
    }
  };
  const auto is_left = [&](const std::string& out) {
    const auto is_merged = [](const fs::directory_entry& entry) {
      return entry.path().string().find(".merged") != std::string::npos;
    };
    const fs::directory_iterator entries(path(out));
    return std::any_of(begin(entries), end(entries), is_merged);
  };
  leave("merged");
  merge({"1"}, "merged");
  EXPECT_FALSE(is_left("merged"));
  leave("1");
  RunOptions options;
  options.experiment = path("1.json");
  options.out = path("1");
  options.fresh = options.quiet = true;
  std::ostringstream text, progress;
  run_command(options, test::fake_catalogue(), text, progress);
  EXPECT_FALSE(is_left("1"));
}

TEST_F(MergeCommand, SaysWhatIsMissing) {
  run("1", "1/3", two_variants());
  run("2", "2/3", two_variants());
  EXPECT_EQ(merge({"1", "2"}, "merged"), 3);
  EXPECT_NE(text_.find("12 of 40 trials of the experiment are missing"), std::string::npos)
      << text_;
}

TEST_F(MergeCommand, MissesNoVariantThatOnlyLeftOut) {
  only_ = {"far"};
  run("1", "1/2", two_variants());
  run("2", "2/2", two_variants());
  EXPECT_EQ(merge({"1", "2"}, "merged"), 0) << text_;
}

TEST_F(MergeCommand, AddsToWhatIsThere) {
  run("whole", "", two_variants());
  run("1", "1/2", two_variants());
  run("2", "2/2", two_variants());
  EXPECT_EQ(merge({"1"}, "merged"), 3);
  EXPECT_EQ(merge({"2"}, "merged"), 0);
  expect_whole("merged");
}

TEST_F(MergeCommand, UnitesVariants) {
  run("whole", "", two_variants());
  json base = two_variants();
  base.erase("variants");
  run("base", "", base);
  only_ = {"far"};
  run("far", "", two_variants());
  EXPECT_EQ(merge({"base", "far"}, "merged"), 0) << text_;
  expect_whole("merged");
}

TEST_F(MergeCommand, FollowsTheExperimentThatIsMerged) {
  for (const char* part : {"1", "2"}) run(part, std::string(part) + "/2", two_variants());
  EXPECT_EQ(merge({"1", "2"}, "merged"), 0);
  json other = two_variants();
  other["variants"] = json::parse(R"([{"name": "near", "replace": {"drift.size_m": 0.5}}])");
  other["starts"]["trials"] = 3;
  other["description"] = "another question";
  for (const char* part : {"1", "2"}) run(part, std::string(part) + "/2", other);
  EXPECT_EQ(merge({"1", "2"}, "merged"), 0) << text_;
  run("whole", "", other);
  expect_whole("merged");
  const json manifest = json::parse(read_whole_file(path("merged") / "manifest.json"));
  EXPECT_EQ(manifest["experiment"]["description"], "another question");
}

TEST_F(MergeCommand, NamesEveryVariantInItsManifest) {
  json far = two_variants();
  json near = two_variants();
  near["variants"] = json::parse(R"([{"name": "near", "replace": {"drift.size_m": 0.5}}])");
  run("far", "", far);
  run("near", "", near);
  for (const auto& order : {std::vector<std::string>{"far", "near"}, {"near", "far"}}) {
    EXPECT_EQ(merge(order, order[0] + " first"), 0) << text_;
    const json manifest = json::parse(read_whole_file(path(order[0] + " first") / "manifest.json"));
    EXPECT_EQ(manifest["experiment"]["variants"].size(), 3U);
    EXPECT_EQ(manifest["planned"], 60);
  }
}

TEST_F(MergeCommand, MissesLoopsInAnyOrder) {
  json loops = two_variants();
  loops["loops"] = true;
  run("whole", "", two_variants());
  run("1", "1/2", loops);
  EXPECT_EQ(merge({"whole", "1"}, "a"), 3);
  EXPECT_NE(text_.find("trials of the experiment are missing"), std::string::npos);
  EXPECT_EQ(merge({"1", "whole"}, "b"), 3);
  EXPECT_NE(text_.find("trials of the experiment are missing"), std::string::npos);
}

TEST_F(MergeCommand, KeepsWhatIsThereWhereItCannotBeDone) {
  run("1", "1/2", two_variants());
  EXPECT_EQ(merge({"1"}, "merged"), 3);
  const std::string before = read_whole_file(path("merged") / "store.sqlite");
  json other = two_variants();
  other["seed"] = 7;
  run("2", "2/2", other);
  EXPECT_NE(fault({"2"}, "merged"), "");
  EXPECT_EQ(read_whole_file(path("merged") / "store.sqlite"), before);
  EXPECT_FALSE(fs::exists(path("merged") / "store.sqlite.merged"));
}

TEST_F(MergeCommand, RefusesDamagedStepsBeforeItWrites) {
  run("1", "1/2", two_variants());
  run("2", "2/2", two_variants());
  EXPECT_EQ(merge({"1"}, "merged"), 3);
  const std::string before = read_whole_file(path("merged") / "store.sqlite");
  for (const char* craft : {"figures = '{'", "figures = '{\"=1+1\": 1.0}'", "step = '=1+1'"}) {
    const std::string store = (path("2") / "store.sqlite").string();
    Database(store, Access::write).run(std::string("UPDATE steps SET ") + craft);
    EXPECT_EQ(fault({"2"}, "merged").rfind(store + ": is damaged: ", 0), 0U) << craft;
    EXPECT_EQ(read_whole_file(path("merged") / "store.sqlite"), before) << craft;
    EXPECT_NE(fault({"2"}, "new"), "") << craft;
    EXPECT_FALSE(fs::exists(path("new"))) << craft;
  }
}

TEST_F(MergeCommand, TakesNoTrialTwice) {
  run("whole", "", two_variants());
  EXPECT_EQ(merge({"whole", "whole"}, "merged"), 0);
  expect_whole("merged");
}

TEST_F(MergeCommand, RefusesWhatDoesNotBelongTogether) {
  run("1", "1/2", two_variants());
  json other = two_variants();
  other["seed"] = 7;
  run("2", "2/2", other);
  const std::string message = fault({"1", "2"}, "merged");
  EXPECT_NE(message.find("seed"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(path("merged")));
}

TEST_F(MergeCommand, RefusesAFolderWithoutResults) {
  fs::create_directories(path("empty"));
  EXPECT_NE(fault({"empty"}, "merged"), "");
  EXPECT_NE(fault({"nowhere"}, "merged"), "");
  EXPECT_FALSE(fs::exists(path("merged")));
}

TEST_F(MergeCommand, RefusesAStoreThatIsNone) {
  folder_.write("1/store.sqlite", "this is no database, whatever its name says");
  EXPECT_NE(fault({"1"}, "merged"), "");
  EXPECT_FALSE(fs::exists(path("merged")));
}

}  // namespace
}  // namespace croon::experiments

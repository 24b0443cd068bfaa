#include "experiments/cli/commands.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/analysis/results.hpp"
#include "experiments/store/store.hpp"
#include "experiments/store/timings_store.hpp"
#include "framework/base/whole_file.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/experiments/support/run_bench.hpp"
#include "test/experiments/support/summary_text.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using test::agreeing;
using test::Bench;
using test::drifting;

/// The rows of timings.csv, sorted, without their seconds.
std::vector<std::string> timed(const fs::path& file) {
  std::istringstream stream(read_whole_file(file));
  std::vector<std::string> rows;
  for (std::string line; std::getline(stream, line);)
    rows.push_back(line.substr(0, line.rfind(',')));
  std::sort(rows.begin(), rows.end());
  return rows;
}

TEST(RunCommand, SameBytesForAnyNumberOfJobs) {
  const Bench bench(agreeing());
  for (const int jobs : {1, 2, 4}) {
    RunOptions options = bench.options(std::to_string(jobs));
    options.jobs = jobs;
    options.clouds = true;
    EXPECT_EQ(bench.run(options), 0);
  }
  const auto one = bench.bytes("1");
  for (const char* name :
       {"store.sqlite", "trials.csv", "extrinsics.json", "success_curve.svg", "summary.csv",
        "summary.json", "manifest.json", "clouds/base/scene1.ply", "clouds/far/scene2.vdb"}) {
    EXPECT_EQ(one.count(name), 1U) << name;
  }
  EXPECT_EQ(one.count("store.sqlite-wal"), 0U);
  EXPECT_TRUE(one == bench.bytes("2"));
  EXPECT_TRUE(one == bench.bytes("4"));
  EXPECT_EQ(timed(bench.folder().path() / "1/timings.csv"),
            timed(bench.folder().path() / "4/timings.csv"));
}

TEST(RunCommand, SameBytesWhereVariantsShareNoStep) {
  json experiment = drifting();
  experiment["variants"].push_back({{"name", "rejected"}, {"replace", {{"behave.how", "reject"}}}});
  experiment["variants"].push_back({{"name", "defeated"}, {"replace", {{"behave.how", "defeat"}}}});
  const Bench bench(experiment);
  RunOptions options = bench.options("shared");
  EXPECT_EQ(bench.run(options), 3);
  options = bench.options("alone");
  options.no_share = true;
  EXPECT_EQ(bench.run(options), 3);
  EXPECT_TRUE(bench.bytes("shared") == bench.bytes("alone"));
  // A variant's times are there as if it had run alone; what is done once per scene, as it was.
  const auto of_trials = [&](const char* out) {
    std::vector<std::string> rows = timed(bench.folder().path() / out / "timings.csv");
    const auto is_of_scene = [](const std::string& row) { return row.find(",-1,") != row.npos; };
    rows.erase(std::remove_if(rows.begin(), rows.end(), is_of_scene), rows.end());
    return rows;
  };
  EXPECT_EQ(of_trials("shared"), of_trials("alone"));
}

TEST(RunCommand, PlansAFreshRun) {
  const Bench bench;
  RunOptions options = bench.options("planned");
  bench.run(options);
  json other = drifting();
  other["seed"] = 7;
  options.experiment = bench.folder().write("other.json", other.dump());
  options.plan = true;
  EXPECT_NE(bench.fault(options), "");
  options.fresh = true;
  EXPECT_EQ(bench.fault(options), "");
  EXPECT_TRUE(fs::exists(bench.folder().path() / "planned/store.sqlite"));
}

TEST(RunCommand, PlansWithoutWriting) {
  const Bench bench;
  RunOptions options = bench.options("planned");
  options.plan = true;
  EXPECT_EQ(bench.run(options), 0);
  EXPECT_FALSE(fs::exists(bench.folder().path() / "planned"));
}

TEST(RunCommand, ShardsTogetherAreTheWhole) {
  const Bench bench;
  bench.run(bench.options("whole"));
  RunOptions part = bench.options("parts");
  part.shard = "2/2";
  bench.run(part);
  EXPECT_FALSE(bench.bytes("parts") == bench.bytes("whole"));
  part.shard = "1/2";
  bench.run(part);
  EXPECT_TRUE(bench.bytes("parts") == bench.bytes("whole"));
}

TEST(RunCommand, VariantsAndTrialsExtendAStore) {
  const Bench bench;
  bench.run(bench.options("whole"));
  RunOptions part = bench.options("parts");
  part.only = {"far"};
  part.trials = 2;
  bench.run(part);
  part.only.clear();
  bench.run(part);
  part.trials = 0;
  bench.run(part);
  EXPECT_TRUE(bench.bytes("parts") == bench.bytes("whole"));
  bench.run(part);
  EXPECT_TRUE(bench.bytes("parts") == bench.bytes("whole"));
}

/// A folder as a kill leaves it: the store open, half of the trials in it, a wall time, and the
/// timings.csv of an earlier run.
void leave_killed_run(const Bench& bench, const std::string& out) {
  const fs::path folder = bench.folder().path();
  fs::create_directory(folder / "open");
  fs::create_directory(folder / out);
  const fs::path store = folder / "open/store.sqlite";
  fs::copy_file(folder / "whole/store.sqlite", store);
  for (const char* table : {"trials", "steps"}) {
    Database(store, Access::write)
        .run("DELETE FROM " + std::string(table) + " WHERE trial % 2 = 0");
  }
  const Store open(store, stored_header(store));
  for (const char* name : {"store.sqlite", "store.sqlite-wal"}) {
    fs::copy_file(folder / "open" / name, folder / out / name);
  }
  bench.folder().write(out + "/store.sqlite.new", "half a file");
  TimingsStore(folder / out / "timings.sqlite", Access::write)
      .add({{std::nullopt, {{{"base", "scene1", "s0", 0}, "drift", 0.5}}}});
  bench.folder().write(out + "/timings.csv", "variant,scene,sensor,trial,step,seconds\n");
}

TEST(RunCommand, ResumesAfterAKill) {
  const Bench bench;
  bench.run(bench.options("whole"));
  leave_killed_run(bench, "killed");
  const fs::path timings = bench.folder().path() / "killed/timings.csv";
  EXPECT_EQ(bench.run(bench.options("killed")), 0);
  EXPECT_TRUE(bench.bytes("killed") == bench.bytes("whole"));
  const std::string text = read_whole_file(timings);
  EXPECT_EQ(text.rfind("variant,scene,sensor,trial,step,seconds\n,scene", 0), 0U);
  EXPECT_NE(text.find("\nbase,scene1,s0,0,drift,0.5\n"), std::string::npos);
  const auto steps = [](const std::vector<std::string>& rows) {
    return std::count_if(rows.begin(), rows.end(), [](const std::string& row) {
      return row.rfind("base,", 0) == 0 || row.rfind("far,", 0) == 0;
    });
  };
  // Half of the 2 x 2 x 2 x 6 trials were there; each of the others has two steps; one row was
  // there.
  EXPECT_EQ(steps(timed(timings)), 24 * 2 + 1);
}

/// As if another build had made the trials of the store `path`.
void change_build(const fs::path& path) {
  Database(path, Access::write)
      .run(
          "UPDATE meta SET value = replace(value, '\"program_sha256\":\"', "
          "'\"program_sha256\":\"0') WHERE name = 'builds'");
}

TEST(RunCommand, GoesOnWithTheTrialsOfAnotherBuild) {
  const Bench bench;
  RunOptions options = bench.options("out");
  bench.run(options);
  change_build(bench.folder().path() / "out/store.sqlite");
  const auto builds = [&] {
    const json manifest = json::parse(read_whole_file(bench.folder().path() / "out/manifest.json"));
    return manifest.contains("builds") ? manifest["builds"].size() : 1;
  };
  // Nothing to run: this build has no part in the results.
  EXPECT_EQ(bench.run(options), 0);
  EXPECT_EQ(builds(), 1U);
  options.trials = 7;
  std::ostringstream out, progress;
  EXPECT_EQ(run_command(options, test::fake_catalogue(), out, progress), 0);
  EXPECT_EQ(builds(), 2U);
  EXPECT_NE(out.str().find("\nTrials of 2 builds of croon: commit "), std::string::npos);
  options.same_build = true;
  EXPECT_NE(bench.fault(options).find("made by another build of croon"), std::string::npos);
  options.out = bench.folder().path() / "new";
  EXPECT_EQ(bench.run(options), 0);
  EXPECT_EQ(bench.run(options), 0);
}

TEST(RunCommand, RefusesTrialsOfAnotherVersionOfAStage) {
  const Bench bench;
  bench.run(bench.options("out"));
  Database(bench.folder().path() / "out/store.sqlite", Access::write)
      .run(
          "UPDATE meta SET value = replace(value, 'step/drift\":1', 'step/drift\":7') "
          "WHERE name = 'versions'");
  EXPECT_NE(bench.fault(bench.options("out")).find("version of step/drift was 7 and is 1; --fresh"),
            std::string::npos);
}

TEST(RunCommand, RefusesToMixResultsAndStartsOverWhenTold) {
  const Bench bench;
  bench.run(bench.options("out"));
  json other = drifting();
  other["seed"] = 2;
  bench.folder().write("x.json", other.dump());
  const auto before = bench.bytes("out");
  const std::string fault = bench.fault(bench.options("out"));
  EXPECT_NE(fault.find("/seed was 1 and is 2"), std::string::npos) << fault;
  EXPECT_TRUE(bench.bytes("out").at("store.sqlite") == before.at("store.sqlite"));
  RunOptions fresh = bench.options("out");
  fresh.fresh = true;
  bench.folder().write("out/notes.txt", "mine");
  EXPECT_EQ(bench.run(fresh), 0);
  bench.run(bench.options("other"));
  auto after = bench.bytes("out");
  EXPECT_EQ(after.erase("notes.txt"), 1U);
  EXPECT_TRUE(after == bench.bytes("other"));
}

TEST(RunCommand, TellsResultsByKindWhereTheDatasetHasKinds) {
  json experiment = drifting();
  experiment["dataset"]["kinds"] = true;
  const Bench with(experiment), without;
  EXPECT_EQ(with.run(with.options("out")), 0);
  const auto files = with.bytes("out");
  EXPECT_NE(files.at("summary_by_kind.csv").find("\nbase,narrow,s1,"), std::string::npos);
  EXPECT_TRUE(json::parse(files.at("summary.json")).contains("kinds"));
  EXPECT_EQ(without.run(without.options("out")), 0);
  without.folder().write("out/summary_by_kind.csv", "of an earlier run");
  EXPECT_EQ(without.run(without.options("out")), 0);
  const auto others = without.bytes("out");
  EXPECT_EQ(others.count("summary_by_kind.csv"), 0U);
  EXPECT_EQ(others.at("trials.csv"), files.at("trials.csv"));
  EXPECT_EQ(others.at("summary.csv"), files.at("summary.csv"));
  EXPECT_FALSE(json::parse(others.at("summary.json")).contains("kinds"));
}

TEST(RunCommand, SaysWithItsCodeThatATrialFailed) {
  json experiment = drifting();
  experiment["pipeline"][1]["how"] = "defeat";
  const Bench bench(experiment);
  EXPECT_EQ(bench.run(bench.options("out")), 3);
}

TEST(RunCommand, SaysThatTheStoreHasLostTrials) {
  const Bench bench;
  const auto said = [&] {
    std::ostringstream out, progress;
    run_command(bench.options("out"), test::fake_catalogue(), out, progress);
    return progress.str();
  };
  RunOptions first = bench.options("out");
  first.only = {"far"};
  EXPECT_EQ(bench.run(first), 0);
  const fs::path store = bench.folder().path() / "out" / "store.sqlite";
  fs::copy_file(store, bench.folder().path() / "before.sqlite");
  EXPECT_EQ(said(), "");
  EXPECT_EQ(said(), "");
  // As if the log of the second run, which was killed, were lost.
  fs::copy_file(bench.folder().path() / "before.sqlite", store,
                fs::copy_options::overwrite_existing);
  EXPECT_NE(said().find("store.sqlite: stored trials are missing: the store is lost, or its log "
                        "store.sqlite-wal"),
            std::string::npos);
  EXPECT_EQ(said(), "");
}

TEST(RunCommand, KnowsNoSuccessWithoutTruthAlsoIfEveryTrialFailed) {
  json experiment = drifting();
  experiment["pipeline"][1]["how"] = "defeat";
  experiment["starts"]["around"] = "nominal";
  const auto summary_of = [&](bool truth) {
    experiment["dataset"]["truth"] = truth;
    const Bench bench(experiment);
    EXPECT_EQ(bench.run(bench.options("out")), 3);
    return test::summary_text(read_results(bench.folder().path() / "out").summary);
  };
  const std::string without = summary_of(false);
  EXPECT_NE(without.find("Agreement (no ground truth)"), std::string::npos) << without;
  EXPECT_EQ(without.find("success"), std::string::npos) << without;
  const std::string with = summary_of(true);
  EXPECT_NE(with.find("success"), std::string::npos) << with;
  EXPECT_EQ(with.find("agreement"), std::string::npos) << with;
}

TEST(ClaimsCommand, RefusesAFolderThatIsNamedTwice) {
  const Bench bench(agreeing());
  EXPECT_EQ(bench.run(bench.options("out")), 0);
  const fs::path folder = bench.folder().path() / "out";
  std::ostringstream once;
  EXPECT_EQ(claims_command({folder}, once), 0);
  std::ostringstream twice;
  try {
    claims_command({folder, folder / "."}, twice);
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().front().line(),
              (folder / ".").string() + ": expected each folder once, found this one twice");
  }
  EXPECT_EQ(twice.str(), "");
}

TEST(RunCommand, WritesNothingWhereTheRequestIsWrong) {
  json experiment = drifting();
  experiment["dataset"]["truth"] = false;
  const Bench bench(experiment);
  EXPECT_NE(bench.fault(bench.options("out")).find("has no truth pose"), std::string::npos);
  RunOptions options = bench.options("out");
  options.only = {"fra"};
  EXPECT_NE(bench.fault(options).find("did you mean \"far\"?"), std::string::npos);
  options = bench.options("out");
  options.shard = "3/2";
  EXPECT_NE(bench.fault(options).find("expected K/N"), std::string::npos);
  options = bench.options("out");
  options.experiment = bench.folder().path() / "none.json";
  EXPECT_NE(bench.fault(options), "");
  EXPECT_FALSE(fs::exists(bench.folder().path() / "out"));
}

}  // namespace
}  // namespace croon::experiments

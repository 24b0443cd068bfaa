// What is in the folder that a run writes to: nobody's file is destroyed, and nothing is written
// through a link.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/session/result_files.hpp"
#include "experiments/store/database.hpp"
#include "framework/base/whole_file.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/experiments/support/run_bench.hpp"

namespace croon::experiments {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using test::agreeing;
using test::Bench;

TEST(ResultFolder, KeepsTheFilesOfOthers) {
  const Bench bench;
  for (const char* name :
       {"trials.csv", "timings.csv", "manifest.json", "clouds/mine.ply", "store.sqlite.new",
        "store.sqlite-wal", "store.sqlite.merged", "timings.sqlite", "timings.sqlite-journal"}) {
    const fs::path file = bench.folder().write("out/" + std::string(name), "mine");
    const fs::path named = bench.folder().path() / "out" / *fs::path(name).begin();
    for (const bool is_fresh : {false, true}) {
      RunOptions options = bench.options("out");
      options.fresh = is_fresh;
      EXPECT_EQ(bench.fault(options),
                named.string() +
                    ": would be overwritten, but the folder has no results of croon; "
                    "choose another folder with --out");
    }
    EXPECT_EQ(read_whole_file(file), "mine");
    EXPECT_FALSE(fs::exists(bench.folder().path() / "out/store.sqlite"));
    fs::remove_all(bench.folder().path() / "out");
  }
}

/// The folder "out" is refused, also with --fresh, with a fault that begins so.
void expect_refused(const Bench& bench, const std::string& fault) {
  for (const bool is_fresh : {false, true}) {
    RunOptions options = bench.options("out");
    options.fresh = is_fresh;
    EXPECT_EQ(bench.fault(options).substr(0, fault.size()), fault);
  }
}

TEST(ResultFolder, WritesThroughNoLink) {
  const Bench bench;
  EXPECT_EQ(bench.run(bench.options("out")), 0);
  const fs::path file = bench.folder().write("file", "mine");
  for (const char* name : {"store.sqlite", "store.sqlite-wal", "timings.sqlite", "trials.csv",
                           "timings.csv", "manifest.json", "clouds"}) {
    const fs::path link = bench.folder().path() / "out" / name;
    fs::remove_all(link);
    fs::create_symlink(file, link);
    expect_refused(bench, link.string() + ": expected a file or nothing, found a symbolic link");
    EXPECT_EQ(read_whole_file(file), "mine");
    fs::remove(link);
    bench.run(bench.options("out"));
  }
}

TEST(ResultFolder, ChangesNothingThroughAHardLink) {
  const Bench bench;
  EXPECT_EQ(bench.run(bench.options("out")), 0);
  const fs::path file = bench.folder().write("file", "mine");
  for (const char* name : {"store.sqlite", "store.sqlite-wal", "store.sqlite.new", "timings.sqlite",
                           "timings.sqlite-journal"}) {
    const fs::path link = bench.folder().path() / "out" / name;
    fs::remove(link);
    fs::create_hard_link(file, link);
    expect_refused(bench, link.string() + ": expected a file with one name, found a hard link");
    EXPECT_EQ(read_whole_file(file), "mine");
    fs::remove(link);
    bench.run(bench.options("out"));
  }
  // A table is replaced.
  fs::remove(bench.folder().path() / "out/trials.csv");
  fs::create_hard_link(file, bench.folder().path() / "out/trials.csv");
  EXPECT_EQ(bench.run(bench.options("out")), 0);
  EXPECT_EQ(read_whole_file(file), "mine");
}

TEST(ResultFolder, ReplacesNoOtherManifest) {
  const Bench bench;
  EXPECT_EQ(bench.run(bench.options("out")), 0);
  const std::string store = read_whole_file(bench.folder().path() / "out/store.sqlite");
  for (const char* bytes : {"", "{\"croon\": ", "{\"name\": \"of a web page\"}"}) {
    const fs::path file = bench.folder().write("out/manifest.json", bytes);
    expect_refused(bench, file.string() + ": is damaged or not a manifest of croon");
    EXPECT_EQ(read_whole_file(file), bytes);
  }
  EXPECT_EQ(read_whole_file(bench.folder().path() / "out/store.sqlite"), store);
}

TEST(ResultFolder, RefusesWhatIsNoFileBeforeItRuns) {
  const Bench bench;
  for (const char* name : {"manifest.json", "trials.csv", "timings.sqlite"}) {
    const fs::path pipe = bench.folder().path() / "out" / name;
    fs::create_directories(pipe.parent_path());
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    expect_refused(
        bench, pipe.string() + ": expected a file or nothing, found something that is not a file");
    EXPECT_FALSE(fs::exists(bench.folder().path() / "out/store.sqlite"));
    fs::remove(pipe);
  }
}

TEST(ResultFolder, WritesCloudsOfVariantsWithLongNames) {
  json experiment = agreeing();
  const std::string common(300, 'v');
  experiment["variants"][0]["name"] = common + "1";
  experiment["variants"].push_back({{"name", common + "2"}});
  const Bench bench(experiment);
  RunOptions options = bench.options("out");
  options.clouds = true;
  EXPECT_EQ(bench.run(options), 0);
  int folders = 0;
  for (const fs::directory_entry& entry :
       fs::directory_iterator(bench.folder().path() / "out/clouds")) {
    EXPECT_TRUE(fs::exists(entry.path() / "scene1.ply"));
    ++folders;
  }
  EXPECT_EQ(folders, 3);
}

TEST(ResultFolder, WritesCloudsThroughNoLink) {
  const Bench bench(agreeing());
  RunOptions options = bench.options("out");
  options.clouds = true;
  EXPECT_EQ(bench.run(options), 0);
  const fs::path link = bench.folder().path() / "out/clouds/base";
  const fs::path elsewhere = bench.folder().path() / "elsewhere";
  fs::rename(link, elsewhere);
  fs::remove(elsewhere / "scene1.ply");
  fs::create_symlink(elsewhere, link);
  EXPECT_EQ(bench.fault(options),
            link.string() + ": expected a folder or nothing, found a symbolic link");
  EXPECT_FALSE(fs::exists(elsewhere / "scene1.ply"));
  // --fresh does not delete through it either, and writes nothing.
  options.fresh = true;
  EXPECT_NE(bench.fault(options), "");
  EXPECT_TRUE(fs::exists(elsewhere / "scene2.ply"));
}

TEST(ResultFolder, FreshDeletesItsOwnCloudsAlone) {
  const Bench bench(agreeing());
  RunOptions options = bench.options("out");
  options.clouds = true;
  EXPECT_EQ(bench.run(options), 0);
  const fs::path note = bench.folder().write("out/clouds/base/note.txt", "mine");
  const std::vector<fs::path> clouds = {bench.folder().write("out/clouds/mine.ply", "mine"),
                                        bench.folder().write("out/clouds/base/mine.ply", "mine"),
                                        bench.folder().write("out/clouds/base/mine.vdb", "mine")};
  options.clouds = false;
  options.fresh = true;
  EXPECT_EQ(bench.run(options), 0);
  EXPECT_EQ(read_whole_file(note), "mine");
  for (const fs::path& cloud : clouds) EXPECT_EQ(read_whole_file(cloud), "mine");
  EXPECT_FALSE(fs::exists(note.parent_path() / "scene1.vdb"));
  EXPECT_FALSE(fs::exists(note.parent_path() / "scene1.ply"));
  EXPECT_FALSE(fs::exists(bench.folder().path() / "out/clouds/far"));
}

TEST(ResultFolder, ReplacesNoForeignCloud) {
  const Bench bench(agreeing());
  RunOptions options = bench.options("out");
  EXPECT_EQ(bench.run(options), 0);
  const std::vector<fs::path> clouds = {bench.folder().write("out/clouds/base/scene1.ply", "mine"),
                                        bench.folder().write("out/clouds/far/scene2.vdb", "mine")};
  options.clouds = true;
  EXPECT_EQ(bench.run(options), 3);
  for (const fs::path& cloud : clouds) EXPECT_EQ(read_whole_file(cloud), "mine");
  EXPECT_TRUE(fs::exists(bench.folder().path() / "out/clouds/base/scene2.vdb"));
}

/// Runs the experiment so that the folder has clouds and a picture.
RunOptions with_clouds(const Bench& bench, int trials) {
  RunOptions options = bench.options("out");
  options.trials = trials;
  options.clouds = true;
  options.png = true;
  EXPECT_EQ(bench.run(options), 0);
  options.clouds = false;
  options.png = false;
  return options;
}

TEST(ResultFolder, HasNoCloudsOfOtherResults) {
  const Bench bench(agreeing());
  const fs::path out = bench.folder().path() / "out";
  RunOptions options = with_clouds(bench, 4);
  const fs::path note = bench.folder().write("out/clouds/far/note.txt", "mine");
  // The same results have the same clouds.
  EXPECT_EQ(bench.run(options), 0);
  EXPECT_TRUE(fs::exists(out / "clouds/base/scene1.ply"));
  EXPECT_TRUE(fs::exists(out / "before_after.png"));
  options.trials = 6;
  EXPECT_EQ(bench.run(options), 0);
  EXPECT_FALSE(fs::exists(out / "clouds/base"));
  EXPECT_FALSE(fs::exists(out / "clouds/far/scene1.ply"));
  EXPECT_FALSE(fs::exists(out / "before_after.png"));
  EXPECT_EQ(read_whole_file(note), "mine");
}

TEST(ResultFolder, HasNoCloudsOfAVariantThatIsNoMore) {
  json experiment = agreeing();
  const Bench bench(experiment);
  RunOptions options = with_clouds(bench, 6);
  experiment["variants"].clear();
  bench.folder().write("x.json", experiment.dump());
  options.clouds = true;
  EXPECT_EQ(bench.run(options), 0);
  EXPECT_TRUE(fs::exists(bench.folder().path() / "out/clouds/base/scene1.ply"));
  EXPECT_FALSE(fs::exists(bench.folder().path() / "out/clouds/far"));
}

TEST(ResultFolder, SaysThatThereAreNoClouds) {
  const Bench bench(agreeing());
  RunOptions options = bench.options("out");
  options.trials = 1;
  options.clouds = true;
  std::ostringstream out, progress;
  EXPECT_EQ(run_command(options, test::fake_catalogue(), out, progress), 0);
  EXPECT_EQ(progress.str(), "");
  EXPECT_NE(out.str().find("\nNo clouds to write: no sensor has trials that agree.\n"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(bench.folder().path() / "out/clouds"));
}

TEST(ResultFolder, KeepsItsResultsIfWallTimesAreDamaged) {
  const Bench bench;
  const fs::path out = bench.folder().path() / "out";
  RunOptions options = bench.options("out");
  for (const bool is_finished : {true, false}) {
    options.only = is_finished ? std::vector<std::string>() : std::vector<std::string>{"base"};
    options.fresh = true;  // Also deletes the damaged file.
    EXPECT_EQ(bench.run(options), 0);
    EXPECT_TRUE(
        Database(out / "timings.sqlite", Access::read).prepare("SELECT 1 FROM timings").next());
    options = bench.options("out");
    const fs::path damaged = bench.folder().write("out/timings.sqlite", "this is no database");
    const auto before = bench.bytes("out");
    EXPECT_EQ(bench.fault(options),
              damaged.string() +
                  ": expected the store of a run, found a file that is not a database; "
                  "only wall times are read from this file: move it away to continue without those "
                  "of earlier trials");
    EXPECT_TRUE(bench.bytes("out") == before);
  }
  fs::remove(out / "timings.sqlite");
  EXPECT_EQ(bench.run(options), 0);
  bench.run(bench.options("whole"));
  EXPECT_TRUE(bench.bytes("out") == bench.bytes("whole"));
}

TEST(ResultFolder, KeepsWallTimesThatNoDatabaseHas) {
  const Bench bench;
  EXPECT_EQ(bench.run(bench.options("out")), 0);
  const fs::path out = bench.folder().path() / "out";
  const std::string times = read_whole_file(out / "timings.csv");
  EXPECT_EQ(left_out_times_text(out), "");
  fs::remove(out / "timings.sqlite");
  const std::string left_out = (out / "timings.csv").string() +
                               ": its wall times are left out: they are read from "
                               "timings.sqlite, which is missing\n";
  std::ostringstream text, progress;
  EXPECT_EQ(run_command(bench.options("out"), test::fake_catalogue(), text, progress), 0);
  EXPECT_NE(progress.str().find("croon: " + left_out), std::string::npos);
  EXPECT_EQ(read_whole_file(out / "timings.csv"), times);
  EXPECT_FALSE(fs::exists(out / "timings.sqlite"));
  std::ostringstream merged;
  EXPECT_EQ(merge_command({{out}, bench.folder().path() / "merged"}, merged), 0);
  EXPECT_NE(merged.str().find(left_out), std::string::npos);
  fs::remove(out / "timings.csv");
  EXPECT_EQ(left_out_times_text(out), "");
}

TEST(ResultFolder, NeedsAFolderThatItMayWriteTo) {
  const Bench bench;
  bench.folder().write("file", "");
  EXPECT_NE(bench.fault(bench.options("file")).find("expected a folder"), std::string::npos);
  EXPECT_NE(bench.fault(bench.options("file/below")).find("expected a folder"), std::string::npos);
}

}  // namespace
}  // namespace croon::experiments

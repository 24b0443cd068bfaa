// A store is input like any other file: whatever is in it, a command ends with 0, 2 or 3, in
// bounded time, and with one line if it refuses it.
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "experiments/analysis/results.hpp"
#include "experiments/cli/commands.hpp"
#include "experiments/store/database.hpp"
#include "experiments/store/store.hpp"
#include "framework/base/error.hpp"
#include "framework/base/rng.hpp"
#include "framework/base/whole_file.hpp"
#include "test/experiments/support/fake_stages.hpp"
#include "test/support/temp_folder.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExperiment = R"({
  "name": "x", "dataset": {"type": "fake", "sensors": 1}, "starts": {"trials": 3},
  "pipeline": [{"step": "drift"}, {"step": "behave", "how": "judge"}]})";

/// Runs SQL without SQLite's defences. Returns false if even so the types of columns refuse it.
bool run_sql(const fs::path& path, const std::string& sql) {
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  char* why = nullptr;
  const std::string text = "PRAGMA ignore_check_constraints = ON; " + sql;
  const int code = sqlite3_exec(database, text.c_str(), nullptr, nullptr, &why);
  EXPECT_TRUE(code == SQLITE_OK || code == SQLITE_CONSTRAINT)
      << sql << ": " << (why == nullptr ? "" : why);
  sqlite3_free(why);
  sqlite3_close(database);
  return code == SQLITE_OK;
}

class CraftedStore : public testing::Test {
 protected:
  CraftedStore() {
    folder_.write("x.json", kExperiment);
    EXPECT_EQ(run("good"), 0);
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }
  fs::path store() const { return path("bad") / "store.sqlite"; }

  int run(const std::string& out, bool is_fresh = false) const {
    RunOptions options;
    options.fresh = is_fresh;
    options.experiment = path("x.json");
    options.out = path(out);
    options.quiet = true;
    std::ostringstream text, progress;
    return run_command(options, test::fake_catalogue(), text, progress);
  }

  /// The folder `bad` with a copy of the good store.
  void copy_good() const {
    fs::remove_all(path("bad"));
    fs::create_directory(path("bad"));
    fs::copy_file(path("good/store.sqlite"), store());
  }

  ExportOptions of_bad(const std::string& format) const {
    ExportOptions options;
    options.folders = {path("bad")};
    options.format = format;
    return options;
  }

  /// Runs export, claims, merge and run. Those that refuse the store must do so as the program
  /// prints it, in one line; any other exception fails the test. Returns which did, "ecmr" for all.
  std::string refusals(const std::string& what) const {
    fs::remove_all(path("merged"));
    MergeOptions merge;
    merge.folders = {path("bad")};
    merge.out = path("merged/deep");
    std::ostringstream answer;
    const std::vector<std::function<void()>> commands = {
        [&] { export_command(of_bad("md"), answer); },
        [&] { claims_command({path("bad")}, answer); }, [&] { merge_command(merge, answer); },
        [&] { run("bad"); }};
    std::string refused;
    for (std::size_t i = 0; i < commands.size(); ++i) {
      try {
        commands[i]();
      } catch (const InputError& error) {
        refused += "ecmr"[i];
        std::ostringstream text;
        print_faults(error, text);
        const std::string line = text.str();
        EXPECT_EQ(std::count(line.begin(), line.end(), '\n'), 1) << what << ": " << line;
        EXPECT_EQ(line.find("bug"), std::string::npos) << what << ": " << line;
        EXPECT_EQ(line.find("json.exception"), std::string::npos) << what << ": " << line;
      }
      EXPECT_FALSE(!refused.empty() && fs::exists(path("merged"))) << what;
    }
    return refused;
  }

  test::TempFolder folder_;
};

/// Sets a member of the manifest.
std::string manifest(const std::string& member, const std::string& value) {
  return "UPDATE meta SET value = json_set(value, '$." + member + "', json('" + value +
         "')) WHERE name = 'manifest'";
}

std::string meta(const std::string& name, const std::string& value) {
  return "UPDATE meta SET value = " + value + " WHERE name = '" + name + "'";
}

/// Gives the row of `table` the id `id`, everywhere.
std::string id(const std::string& table, const std::string& column, const std::string& id) {
  return "UPDATE " + table + " SET id = " + id + " WHERE name = (SELECT min(name) FROM " + table +
         "); UPDATE OR IGNORE trials SET " + column + " = " + id + "; UPDATE OR IGNORE steps SET " +
         column + " = " + id;
}

TEST_F(CraftedStore, IsRefusedInOneLine) {
  const std::string deep(200000, '[');
  std::string many_variants = "[{}";
  for (int i = 0; i < 20000; ++i) many_variants += ",{}";
  many_variants += "]";
  const std::vector<std::string> crafts = {
      id("variants", "variant", "-5"),
      id("variants", "variant", "1099511627776"),
      id("scenes", "scene", "-1"),
      id("scenes", "scene", "9223372036854775807"),
      id("sensors", "sensor", "-9223372036854775808"),
      "UPDATE trials SET variant = 77",
      "UPDATE steps SET scene = 77 WHERE scene = 1",
      "DELETE FROM variants",
      "UPDATE variants SET place = 'first'",
      "UPDATE scenes SET place = -1 WHERE id = 1",
      "UPDATE scenes SET place = 1099511627776 WHERE id = 1",
      "INSERT INTO scenes(name, kind, place) SELECT 'again', kind, place FROM scenes LIMIT 1",
      "UPDATE steps SET place = 1099511627776 WHERE place = 0",
      "UPDATE trials SET reason = printf('%.*c', 100000, 'a')",
      "UPDATE sensors SET name = 'all'",
      "INSERT INTO sensors(name, reference) SELECT 'left', name FROM sensors",
      "INSERT INTO sensors(name, reference) SELECT 'left>x', name FROM sensors",
      "INSERT INTO sensors(name, reference) SELECT 'left>' || name, name FROM sensors",
      "UPDATE scenes SET name = X'00ff' WHERE id = 1",
      "UPDATE trials SET trial = -1 WHERE trial = 0",
      "UPDATE trials SET trial = 1099511627776 WHERE trial = 0",
      "UPDATE trials SET trial = 'zero' WHERE trial = 0",
      "UPDATE trials SET status = NULL",
      "UPDATE trials SET status = 'fine'",
      "UPDATE trials SET status = 7",
      "UPDATE trials SET reason = X'00'",
      "UPDATE trials SET roll_error_rad = 'far'",
      "UPDATE trials SET roll_error_rad = NULL",
      "UPDATE trials SET translation_error_m = 9e999",
      "UPDATE trials SET r00 = NULL",
      "UPDATE trials SET tx_m = -9e999",
      "UPDATE trials SET tx_m = 1e300",
      "UPDATE trials SET r00 = 0.0, r01 = 0.0, r02 = 0.0",
      "UPDATE trials SET r00 = 1e15, r11 = 1e15, r22 = 1e15",
      "UPDATE trials SET r00 = -r00, r01 = -r01, r02 = -r02",
      "UPDATE trials SET r20 = -r20, r21 = -r21, r22 = -r22",
      "UPDATE trials SET r00 = r10, r01 = r11, r02 = r12",
      "UPDATE trials SET rotation_error_rad = -0.1",
      "UPDATE trials SET rotation_error_rad = 3.2",
      "UPDATE trials SET translation_error_m = -0.1",
      "UPDATE trials SET status = 'failed'",
      "UPDATE trials SET status = 'finished'",
      "UPDATE trials SET status = 'inaccurate', roll_error_rad = NULL, pitch_error_rad = NULL, "
      "yaw_error_rad = NULL, x_error_m = NULL, y_error_m = NULL, z_error_m = NULL, "
      "rotation_error_rad = NULL, translation_error_m = NULL",
      "UPDATE trials SET trial = 999999 WHERE trial = 1",
      "DELETE FROM trials WHERE trial = 1",
      "DELETE FROM meta",
      "DELETE FROM meta WHERE name IN ('dataset', 'inputs', 'seed', 'starts', 'success')",
      "UPDATE variants SET name = '=1+1'",
      "UPDATE scenes SET name = char(27) || '[2J' WHERE id = 1",
      "UPDATE scenes SET name = 'a' || char(10) || 'b' WHERE id = 1",
      "UPDATE scenes SET name = '' WHERE id = 1",
      "UPDATE scenes SET kind = '@kind' WHERE id = 1",
      "UPDATE scenes SET kind = '-2+3+cmd|'' /C calc''!A0' WHERE id = 1",
      "UPDATE sensors SET name = CAST(X'61FF' AS TEXT)",
      "UPDATE sensors SET reference = '+1'",
      "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 10001) "
      "INSERT INTO variants(name, pipeline, place) SELECT 'v' || i, '[]', i FROM n",
      "UPDATE variants SET pipeline = '{'",
      "UPDATE variants SET name = printf('%.*c', 100000, 'a')",
      "UPDATE scenes SET kind = printf('%.*c', 100000, 'a') WHERE id = 1",
      "UPDATE covariances SET c00 = NULL",
      "UPDATE covariances SET c00 = 'much'",
      "UPDATE covariances SET c00 = -1.0",
      "UPDATE covariances SET c00 = 9e999",
      "UPDATE covariances SET c33 = 1e15",
      "UPDATE covariances SET c01 = 1.5",
      "UPDATE covariances SET c01 = 0.9, c12 = 0.9, c02 = -0.9",
      "UPDATE covariances SET yaw = NULL",
      "UPDATE covariances SET yaw = 'certain'",
      "UPDATE covariances SET sensor = 77",
      "UPDATE covariances SET trial = 999999 WHERE trial = 1",
      "UPDATE steps SET figures = NULL",
      "UPDATE steps SET information = X'00'",
      manifest("experiment.variants", "[]"),
      manifest("experiment.variants", "{}"),
      manifest("experiment.variants", many_variants),
      manifest("experiment", "7"),
      manifest("experiment.seed", "-1"),
      manifest("experiment.starts.sweep", R"({"rotation_deg":[0,10],"levels":0})"),
      manifest("experiment.starts.sweep", R"({"rotation_deg":[0,10],"levels":2000000000})"),
      manifest("planned", "-1"),
      manifest("planned", "1e300"),
      manifest("planned", "9223372036854775807"),
      meta("manifest",
           "'{\"more\":" + deep + std::string(deep.size(), ']') + ",' || substr(value, 2)"),
      meta("manifest", "''"),
      meta("manifest", "'{}'"),
      meta("manifest", "'" + deep + "'"),
      meta("dataset", "zeroblob(100000)"),
      meta("trials", "'many'"),
      meta("trials", "'0'"),
      meta("trials", "'3x'"),
      meta("trials", "'-1'"),
      meta("trials", "'2000000000'"),
      meta("trials", "'99999999999999999999'"),
      meta("versions", "'[]'"),
      meta("versions", R"('{"framework": "one"}')"),
      meta("versions", R"('{"framework": 1.5e300}')"),
      meta("versions", R"('{"framework": 4294967297}')"),
      meta("builds", "'7'"),
      meta("builds", "'[{}]'"),
      meta("format", "'1e9'"),
      "DELETE FROM meta WHERE name = 'manifest'",
      "DROP TABLE steps",
      "DROP TABLE covariances",
      "DROP VIEW named_covariances; DROP TABLE covariances",
      "DROP VIEW named_trials",
      "CREATE TABLE more(a)",
      "CREATE TRIGGER t AFTER UPDATE ON variants BEGIN DELETE FROM trials; END",
      "CREATE INDEX i ON trials(status)",
      "ALTER TABLE trials RENAME TO t; CREATE VIEW trials AS SELECT * FROM t",
      "DROP VIEW named_trials; DROP VIEW named_steps; DROP TABLE variants; CREATE VIEW variants AS "
      "WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n) "
      "SELECT id, 'v' || id AS name, '[]' AS pipeline, 0 AS place FROM n",
      "PRAGMA writable_schema = ON; UPDATE sqlite_master SET sql = 'CREATE VIRTUAL TABLE steps "
      "USING fts5(a)' WHERE name = 'steps'",
      "PRAGMA writable_schema = ON; UPDATE sqlite_master SET rootpage = 1 WHERE name = 'trials'",
      "PRAGMA writable_schema = ON; UPDATE sqlite_master SET sql = 'nonsense' WHERE name = "
      "'trials'",
      "PRAGMA application_id = 7",
  };
  std::size_t made = 0;
  for (const std::string& craft : crafts) {
    copy_good();
    if (!run_sql(store(), craft)) continue;
    ++made;
    const std::string before = read_whole_file(store());
    // What a run writes anew, it does not read.
    const bool is_of_manifest = craft.find("'manifest'") != std::string::npos;
    EXPECT_EQ(refusals(craft.substr(0, 200)), is_of_manifest ? "ecm" : "ecmr")
        << craft.substr(0, 200);
    if (is_of_manifest) continue;
    EXPECT_EQ(read_whole_file(store()), before) << craft.substr(0, 200);
  }
  EXPECT_GT(made, crafts.size() * 3 / 4);
}

TEST_F(CraftedStore, WithDamagedStepsIsNotAddedTo) {
  for (const char* craft :
       {"figures = '{'", "figures = '[]'", "figures = '{\"=1+1\": 1.0}'",
        "figures = '{\"rmse_m\": 1e999}'", "figures = '{\"rmse_m\": {}}'", "step = '@step'"}) {
    copy_good();
    run_sql(store(), std::string("UPDATE steps SET ") + craft);
    const std::string before = read_whole_file(store());
    // The others do not read what steps report.
    EXPECT_EQ(refusals(craft), "mr");
    EXPECT_EQ(read_whole_file(store()), before) << craft;
  }
}

TEST_F(CraftedStore, GivesNoCommandsToTheTerminal) {
  copy_good();
  run_sql(store(), meta("builds",
                        "replace(json_set(value, '$[0].commit', 'c' || char(27), "
                        "'$[0].stage_folders', json('[{\"folder\": \"f\\u001b\", "
                        "\"commit\": \"g\\u001b\"}]')), ' ', ' ')"));
  const Build build = read_store(store()).header.builds.at(0);
  EXPECT_EQ(build.commit, "c?");
  EXPECT_EQ(build.stage_folders.at(0).folder, "f?");
  EXPECT_EQ(build.stage_folders.at(0).commit, "g?");
  run_sql(store(), "UPDATE trials SET reason = 'r' || char(27)");
  EXPECT_EQ(read_store(store()).records.at(0).reason, "r?");
}

TEST_F(CraftedStore, OfManyScenesIsMergedInLinearTime) {
  copy_good();
  run_sql(store(),
          "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < 200000) "
          "INSERT INTO scenes(name, kind) SELECT 's' || i, '' FROM n");
  const StoreHeader header = stored_header(store());
  // With the square it takes more than a quarter of an hour, and the test its time limit.
  EXPECT_EQ(united(header, header).scenes.size(), header.scenes.size());
}

TEST_F(CraftedStore, IsAFile) {
  fs::create_directories(store());
  EXPECT_EQ(refusals("a folder"), "ecmr");
  fs::remove_all(store());
  ASSERT_EQ(::mkfifo(store().c_str(), 0600), 0);
  EXPECT_EQ(refusals("a pipe"), "ecmr");
  fs::remove_all(store());
  fs::create_symlink("/dev/zero", store());
  EXPECT_EQ(refusals("a device"), "ecmr");
}

/// A hot journal of a store of `pages` pages of `page_size` bytes that names the super-journal
/// `name`.
std::string journal_with_name(const std::string& name, std::uint32_t pages,
                              std::uint32_t page_size) {
  const auto number = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
  };
  const std::string magic = "\xD9\xD5\x05\xF9\x20\xA1\x63\xD7";
  std::string header = magic + number(0) + number(12345) + number(pages) + number(512);
  header += number(page_size);
  header.resize(512);
  std::uint32_t sum = 0;
  for (const char c : name) sum += static_cast<unsigned char>(c);
  return header + number(0x40000000 / page_size + 1) + name +
         number(static_cast<std::uint32_t>(name.size())) + number(sum) + magic;
}

TEST_F(CraftedStore, DeletesNoOtherFile) {
  copy_good();
  const std::string thesis = folder_.write("thesis", "mine").string();
  const std::string bytes = read_whole_file(store());
  const auto page_size = static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[16]) << 8 |
                                                    static_cast<unsigned char>(bytes[17]));
  const auto pages = static_cast<std::uint32_t>(bytes.size() / page_size);
  const std::string journal = journal_with_name(thesis, pages, page_size);
  folder_.write("bad/store.sqlite-journal", journal);
  EXPECT_EQ(refusals("a super-journal"), "ecmr");
  EXPECT_TRUE(fs::exists(thesis));
  EXPECT_EQ(read_whole_file(store()), bytes);
  EXPECT_EQ(read_whole_file(store().string() + "-journal"), journal);
  // The same beside the file that a link leads to.
  fs::create_directory(path("far"));
  fs::rename(store(), path("far/s"));
  fs::rename(store().string() + "-journal", path("far/s-journal"));
  fs::create_symlink(path("far/s"), store());
  EXPECT_EQ(refusals("a link"), "ecmr");
  folder_.write("bad/store.sqlite-journal", std::string(512, 'x'));
  EXPECT_EQ(refusals("a link beside a journal"), "ecmr");
  EXPECT_TRUE(fs::exists(thesis));
  EXPECT_EQ(read_whole_file(path("far/s")), bytes);
}

TEST_F(CraftedStore, HasFilesBesideIt) {
  for (const char* ending : {"-journal", "-wal", "-shm"}) {
    copy_good();
    const std::string sibling = store().string() + ending;
    ASSERT_EQ(::mkfifo(sibling.c_str(), 0600), 0);
    EXPECT_EQ(refusals("a pipe"), "ecmr") << ending;
    fs::remove(sibling);
    fs::create_directory(sibling);
    EXPECT_EQ(refusals("a folder"), "ecmr") << ending;
    fs::remove(sibling);
    fs::create_symlink("/dev/zero", sibling);
    EXPECT_EQ(refusals("a link"), "ecmr") << ending;
    EXPECT_NE(test::input_error([&] { read_store(store()); }).find(sibling), std::string::npos);
  }
}

TEST_F(CraftedStore, IsCalledWhatItIs) {
  const auto found = [&] { return test::input_error([&] { read_store(store()); }); };
  fs::create_directories(store().parent_path());
  fs::remove(store());
  EXPECT_NE(found().find("expected the store of a run, found none"), std::string::npos) << found();
  folder_.write("bad/store.sqlite", "");
  EXPECT_NE(found().find("found an empty file"), std::string::npos) << found();
  fs::remove(store());
  Database(store(), Access::create).run("CREATE TABLE notes (text); DROP TABLE notes;");
  EXPECT_NE(found().find("found a database without the tables of a store"), std::string::npos)
      << found();
}

TEST_F(CraftedStore, OfChangedBytesIsReadOrRefused) {
  const std::string good = read_whole_file(path("good/store.sqlite"));
  constexpr int kMutants = 400;
  Rng rng(StreamKey(1).with("mutants"));
  int refused = 0;
  for (int i = 0; i < kMutants; ++i) {
    std::string bytes = good;
    if (i % 10 == 0) bytes.resize(rng.below(bytes.size()));
    const auto changes = i % 10 == 0 ? 0 : 1 + rng.below(8);
    for (std::uint64_t change = 0; change < changes; ++change) {
      // Half of them where the structure is: in the first page.
      const std::size_t range = rng.below(2) == 0 ? std::size_t{200} : bytes.size();
      bytes[rng.below(range)] = static_cast<char>(rng.below(256));
    }
    folder_.write("bad/store.sqlite", bytes);
    try {
      read_store(store());
      std::ostringstream text;
      export_command(of_bad("json"), text);
    } catch (const InputError& error) {
      ++refused;
      EXPECT_EQ(error.faults().size(), 1U);
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(path("bad")), {}), 1) << i;
  }
  EXPECT_GT(refused, kMutants / 4);
}

TEST_F(CraftedStore, OfAnotherProgramKeepsItsBytes) {
  fs::create_directory(path("bad"));
  for (const char* sql : {"CREATE TABLE notes(a); INSERT INTO notes VALUES('mine')",
                          "CREATE TABLE trials(a); INSERT INTO trials VALUES('mine')",
                          "CREATE TABLE meta(k, v); CREATE TABLE trials(a); "
                          "INSERT INTO trials VALUES('mine')",
                          "PRAGMA application_id = 1; CREATE TABLE notes(a)",
                          "PRAGMA journal_mode = WAL; CREATE TABLE notes(a)"}) {
    fs::remove(store());
    run_sql(store(), sql);
    const std::string bytes = read_whole_file(store());
    EXPECT_EQ(refusals(sql), "ecmr") << sql;
    EXPECT_NE(test::input_error([&] { run("bad", true); }), "") << sql;
    EXPECT_EQ(read_whole_file(store()), bytes) << sql;
  }
  fs::remove(store());
  folder_.write("bad/store.sqlite", "notes of mine");
  EXPECT_EQ(refusals("a text"), "ecmr");
  EXPECT_EQ(read_whole_file(store()), "notes of mine");
}

}  // namespace
}  // namespace croon::experiments

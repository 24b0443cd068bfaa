#include "experiments/engine/store.hpp"

#include "experiments/engine/record_row.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

constexpr const char* kFormat = "1";

/// The columns of numbers have no type: SQLite then keeps the bits of a double, -0.0 too.
std::string make_tables() {
  return "CREATE TABLE IF NOT EXISTS meta(name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT "
         "ROWID;"
         "CREATE TABLE IF NOT EXISTS trials(" +
         record_columns() + ", PRIMARY KEY(variant, scene, sensor, trial)) WITHOUT ROWID;";
}

/// Opens `path` for this process alone and makes the tables where they are missing.
Database open_store(const std::filesystem::path& path) {
  Database database(path, Access::write);
  database.run(
      "PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL;"
      "BEGIN EXCLUSIVE;" +
      make_tables() + "COMMIT;");
  return database;
}

Provenance read_meta(const Database& database) {
  Provenance meta;
  Statement select = database.prepare("SELECT name, value FROM meta");
  while (select.next()) meta[select.text(0)] = select.text(1);
  return meta;
}

void write_meta(Database& database, const Provenance& meta) {
  database.run("BEGIN");
  Statement insert = database.prepare("INSERT INTO meta VALUES(?, ?)");
  for (const auto& [name, value] : meta) {
    insert.reset();
    insert.bind(0, name);
    insert.bind(1, value);
    insert.next();
  }
  database.run("COMMIT");
}

/// The names whose values differ, "starts, program".
std::string differences(const Provenance& a, const Provenance& b) {
  std::string names;
  for (const auto& [name, value] : a) {
    const auto other = b.find(name);
    if (other != b.end() && other->second == value) continue;
    names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

/// Throws where the store that is at `path` was made from something else. Looks before Store opens
/// the file: a store that is refused keeps its bytes.
void check_meta(const std::filesystem::path& path, const Provenance& expected) {
  if (!std::filesystem::exists(path)) return;
  const Database database(path, Access::read);
  // A kill before the first commit leaves a store without tables.
  if (!database.prepare("SELECT 1 FROM sqlite_master WHERE name = 'meta'").next()) return;
  const Provenance found = read_meta(database);
  const std::string names = found.empty() ? "" : differences(expected, found);
  if (!names.empty()) {
    throw InputError(path.string(), "",
                     "its trials were made with different " + names +
                         "; --fresh deletes them and starts over, --out writes elsewhere");
  }
}

/// Opens `path`, whose meta is `provenance` or not there yet.
Database checked_store(const std::filesystem::path& path, Provenance provenance) {
  provenance["format"] = kFormat;
  check_meta(path, provenance);
  Database database = open_store(path);
  if (read_meta(database).empty()) write_meta(database, provenance);
  return database;
}

}  // namespace

TrialKey trial_key(const TrialId& id) { return {id.variant, id.scene, id.sensor, id.trial}; }

Store::Store(const std::filesystem::path& path, const Provenance& provenance)
    : database_(checked_store(path, provenance)), insert_(database_.prepare(record_insert())) {}

std::set<TrialKey> Store::keys() const {
  std::set<TrialKey> keys;
  Statement select = database_.prepare("SELECT variant, scene, sensor, trial FROM trials");
  while (select.next()) {
    keys.insert(
        {select.text(0), select.text(1), select.text(2), static_cast<int>(select.integer(3))});
  }
  return keys;
}

std::vector<TrialRecord> Store::records() const {
  std::vector<TrialRecord> records;
  Statement select =
      database_.prepare("SELECT * FROM trials ORDER BY variant, scene, sensor, trial");
  while (select.next()) records.push_back(record_of(select));
  return records;
}

void Store::add(const TrialRecord& record) {
  insert_.reset();
  bind_record(insert_, record);
  insert_.next();
  // The commit is done when the statement is.
  insert_.reset();
}

void rewrite_in_order(const std::filesystem::path& path) {
  const std::filesystem::path ordered = path.string() + ".new";
  std::error_code error;
  std::filesystem::remove(ordered, error);
  {
    Database database(ordered, Access::write);
    database.run("PRAGMA journal_mode = DELETE; PRAGMA synchronous = FULL;");
    Statement attach = database.prepare("ATTACH ? AS old");
    attach.bind(0, path.string());
    attach.next();
    attach.reset();
    database.run("BEGIN;" + make_tables() +
                 "INSERT INTO main.meta SELECT * FROM old.meta ORDER BY name;"
                 "INSERT INTO main.trials SELECT * FROM old.trials"
                 " ORDER BY variant, scene, sensor, trial; COMMIT;");
  }
  std::filesystem::rename(ordered, path, error);
  if (error) throw InputError(path.string(), "", "cannot be replaced: " + error.message());
}

std::vector<std::filesystem::path> store_files(const std::filesystem::path& path) {
  std::vector<std::filesystem::path> files;
  for (const char* ending : {"", "-wal", "-shm", "-journal", ".new", ".new-journal"}) {
    files.push_back(path.string() + ending);
  }
  return files;
}

}  // namespace croon::experiments

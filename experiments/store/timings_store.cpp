#include "experiments/store/timings_store.hpp"

#include <utility>

#include "experiments/store/store_check.hpp"
#include "experiments/store/store_file.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// SQL that creates the table. `place` is the index of a row among those of its trial or scene.
/// Equal rows are one measurement that was merged twice: repeated work differs in its seconds.
std::string timings_schema() {
  return "PRAGMA application_id = " + std::to_string(kApplicationId) +
         "; CREATE TABLE timings(variant TEXT NOT NULL, scene TEXT NOT NULL, sensor TEXT NOT NULL, "
         "trial INTEGER NOT NULL CHECK(trial >= -1), place INTEGER NOT NULL, step TEXT NOT NULL, "
         "seconds REAL NOT NULL CHECK(seconds >= 0), "
         "PRIMARY KEY(variant, scene, sensor, trial, place, step, seconds)) STRICT, WITHOUT ROWID;";
}

/// The database of the file `path`, as described at the constructor of TimingsStore. It uses
/// SQLite's rollback journal instead of a write-ahead log: if such a log were lost together with
/// that of the store, nothing would show that trials are missing.
Database open_timings(const fs::path& path, Access access) try {
  const bool is_new = !has_store(path);
  // SQLite would create it with permissions that differ from those of the umask.
  if (is_new && access == Access::write) write_whole_file(path, "");
  Database database(path, is_new && access == Access::read ? Access::memory : access);
  database.run("PRAGMA synchronous = NORMAL");
  if (is_new) database.run("BEGIN;" + timings_schema() + "COMMIT;");
  check_schema(database, timings_schema());
  check_by(database, "quick_check(1)");
  return database;
} catch (const InputError& error) {
  Fault fault = error.faults().front();
  fault.message +=
      "; only wall times are read from this file: move it away to continue without "
      "those of earlier trials";
  throw InputError(std::vector{std::move(fault)});
}

}  // namespace

fs::path timings_path(const fs::path& folder) { return folder / "timings.sqlite"; }

TimingsStore::TimingsStore(const fs::path& path, Access access)
    : database_(open_timings(path, access)),
      find_(database_.prepare("SELECT 1 FROM timings WHERE variant = ? AND scene = ? AND "
                              "sensor = ? AND trial = ? LIMIT 1")) {}

void TimingsStore::add(const std::vector<Done>& batch) {
  Transaction transaction(database_);
  Statement insert = database_.prepare("INSERT OR IGNORE INTO timings VALUES(?, ?, ?, ?, ?, ?, ?)");
  for (const Done& done : batch) {
    std::int64_t place = 0;
    for (const TimingRow& row : done.timings) {
      insert.bind(0, row.id.variant);
      insert.bind(1, row.id.scene);
      insert.bind(2, row.id.sensor);
      insert.bind(3, std::int64_t{row.id.trial});
      insert.bind(4, place++);
      insert.bind(5, row.step);
      insert.bind(6, row.seconds);
      insert.next();
      insert.reset();
    }
  }
  transaction.commit();
}

void TimingsStore::merge(const fs::path& other) {
  if (!has_store(other)) return;
  const Attachment attachment(database_, other, "other");
  database_.run("INSERT OR IGNORE INTO main.timings SELECT * FROM other.timings");
}

bool TimingsStore::is_empty() const {
  return !database_.prepare("SELECT 1 FROM timings LIMIT 1").next();
}

bool TimingsStore::has(const TrialId& id) {
  find_.bind(0, id.variant);
  find_.bind(1, id.scene);
  find_.bind(2, id.sensor);
  find_.bind(3, std::int64_t{id.trial});
  const bool is_found = find_.next();
  find_.reset();
  return is_found;
}

void TimingsStore::for_each(const std::function<void(const TimingRow&)>& use) const {
  Statement select = database_.prepare(
      "SELECT variant, scene, sensor, trial, step, seconds FROM timings "
      "ORDER BY variant, scene, sensor, trial, place, step, seconds");
  while (select.next()) {
    const TimingRow row{
        {select.text(0), select.text(1), select.text(2), static_cast<int>(select.integer(3))},
        select.text(4),
        select.real(5)};
    if (is_harmless(row.id.variant) && is_harmless(row.id.scene) && is_harmless(row.id.sensor) &&
        is_harmless(row.step)) {
      use(row);
    }
  }
}

}  // namespace croon::experiments

#include "experiments/store/store.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/store/store_check.hpp"
#include "experiments/store/store_header.hpp"
#include "experiments/store/store_schema.hpp"
#include "experiments/store/trial_rows.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

namespace fs = std::filesystem;

/// The tables that map ids to names, and the columns of `trials` with these ids.
struct IdColumn {
  const char* table;
  const char* column;
};
constexpr IdColumn kIdColumns[] = {
    {"variants", "variant"}, {"scenes", "scene"}, {"sensors", "sensor"}};

/// Opens the store `path` exclusively for this process. Its header is `header`, or it has none yet.
Database open_store(const fs::path& path, StoreHeader header) {
  // Compares before opening the file for writing: a refused store keeps its bytes.
  if (has_store(path)) {
    const StoreHeader stored = reading(path, [&] { return read_header(open_to_read(path)); });
    if (!stored.provenance.empty()) refuse_differences(path.string(), stored, header, kFreshRemedy);
    header = continued(stored, header);
  }
  Database database = open_to_write(path);
  write_header(database, header);
  return database;
}

/// SQL that fills temporary tables `map_TABLE(old, new)` with the ids of equal names in `from` and
/// in main.
std::string id_maps(const std::string& from) {
  std::string sql;
  for (const IdColumn& ids : kIdColumns) {
    const std::string table = ids.table;
    sql += "DROP TABLE IF EXISTS temp.map_" + table + "; CREATE TEMP TABLE map_" + table +
           "(old INTEGER PRIMARY KEY, new INTEGER);"
           "INSERT INTO temp.map_" +
           table + " SELECT a.id, b.id FROM " + from + "." + table + " a JOIN main." + table +
           " b ON a.name = b.name;";
  }
  return sql;
}

/// SQL that selects the rows of `table` in `from`, with the ids of main.
std::string with_main_ids(const std::string& from, const std::string& table,
                          const std::string& columns) {
  std::string ids, joins;
  for (const IdColumn& id : kIdColumns) {
    const std::string map = "map_" + std::string(id.table);
    ids += map + ".new AS " + id.column + ", ";
    joins += " JOIN temp." + map + " ON " + map + ".old = t." + id.column;
  }
  return "SELECT " + ids + "t.trial AS trial, " + columns + " FROM " + from + "." + table + " t" +
         joins;
}

constexpr const char* kStepColumns = "place, step, figures, information";

/// A table with a row per trial or step, and its columns after the key.
using StoredTable = std::pair<std::string, std::string>;

/// Throws InputError if `shard` and main contain the same trial with different values of `columns`.
/// `rows` is the query for the rows of `table` in `shard`.
void refuse_doubled(const Database& database, const fs::path& shard, const std::string& table,
                    const std::string& rows, const std::string& columns) {
  Statement doubled = database.prepare(
      "SELECT count(*) FROM (" + rows + " EXCEPT SELECT variant, scene, sensor, trial, " + columns +
      " FROM main." + table + ") s JOIN main." + table + " m USING(variant, scene, sensor, trial)");
  doubled.next();
  if (doubled.integer(0) == 0) return;
  throw InputError(
      shard.string(), "",
      std::to_string(doubled.integer(0)) + " of its trials ended differently in another store");
}

/// The trials of `header` that are in the store, in the order of the store.
std::vector<TrialIndex> trials_in(const fs::path& path, const StoreHeader& header) {
  const Database database = open_to_read(path);
  const StoredIndices indices(database, header);
  Statement select = database.prepare("SELECT variant, scene, sensor, trial FROM trials");
  std::vector<TrialIndex> trials;
  TrialIndex index;
  while (select.next()) {
    if (indices.find(row_of(select), index)) trials.push_back(index);
  }
  return trials;
}

/// The index of a trial, and its record without names.
using IndexedRecord = std::pair<TrialIndex, TrialRecord>;

/// The trials that the experiment still has, in the order of the store.
std::vector<IndexedRecord> records_in(const Database& database, const StoreHeader& header) {
  const StoredIndices indices(database, header);
  std::vector<IndexedRecord> rows;
  Statement select = select_results(database);
  TrialIndex index;
  while (select.next()) {
    const TrialRow row = row_of(select);
    if (row.trial < header.trials && indices.find(row, index)) {
      rows.emplace_back(index, result_of(select));
      const auto& pose = rows.back().second.T_reference_sensor;
      if (pose) check_rotation(database, pose->rotation);
    }
  }
  return rows;
}

/// The index of the record of a trial in the sorted `rows`; std::nullopt if there is none.
std::optional<std::size_t> find_record(const std::vector<IndexedRecord>& rows,
                                       const TrialIndex& index) {
  const auto is_before = [](const IndexedRecord& row, const TrialIndex& wanted) {
    return row.first < wanted;
  };
  const auto found = std::lower_bound(rows.begin(), rows.end(), index, is_before);
  if (found == rows.end() || found->first != index) return std::nullopt;
  return static_cast<std::size_t>(found - rows.begin());
}

/// Adds the covariances to the sorted `rows`.
void add_covariances(const Database& database, const StoreHeader& header,
                     std::vector<IndexedRecord>& rows) {
  const StoredIndices indices(database, header);
  Statement select = select_covariances(database);
  TrialIndex index;
  while (select.next()) {
    const PoseCovariance covariance = stored_covariance_of(select);
    check_covariance(database, covariance.matrix);
    if (!indices.find(row_of(select), index)) continue;
    const std::optional<std::size_t> record = find_record(rows, index);
    if (record) rows[*record].second.covariance = covariance;
  }
}

/// Reads the diagnostics of the steps of the sorted `rows`.
class StepReader {
 public:
  StepReader(const Database& database, const StoreHeader& header,
             const std::vector<IndexedRecord>& rows)
      : indices_(database, header), rows_(rows), select_(select_diagnostics(database)) {}

  StepNumbers read() {
    while (select_.next()) add_row();
    // A store in order is already sorted.
    const auto is_before = [](const StepNumber& a, const StepNumber& b) {
      return a.record < b.record;
    };
    std::stable_sort(steps_.numbers.begin(), steps_.numbers.end(), is_before);
    return std::move(steps_);
  }

 private:
  void add_row() {
    TrialIndex index;
    if (!indices_.find(row_of(select_), index)) return;
    const std::optional<std::size_t> found = find_record(rows_, index);
    if (!found) return;
    const auto record = static_cast<std::uint32_t>(*found);
    const auto [step, diagnostics] = diagnostics_of(select_);
    for (const auto& [name, value] : diagnostics) {
      steps_.numbers.push_back({record, index_of(step), index_of(name), value});
    }
  }

  std::uint32_t index_of(const std::string& name) {
    const auto [entry, is_new] =
        known_.emplace(name, static_cast<std::uint32_t>(steps_.names.size()));
    if (is_new) steps_.names.push_back(name);
    return entry->second;
  }

  StoredIndices indices_;
  const std::vector<IndexedRecord>& rows_;
  Statement select_;
  StepNumbers steps_;
  std::map<std::string, std::uint32_t> known_;
};

/// Reads everything that reports need from a store.
StoredRun run_in(const Database& database, Content content) {
  check_content(database);
  StoredRun run{read_header(database), {}, {}};
  if (run.header.provenance.empty()) {
    throw InputError(database.file(), "", "expected the store of a run, found none");
  }
  std::vector<IndexedRecord> rows = records_in(database, run.header);
  // A store in order is already sorted.
  const auto is_before = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (!std::is_sorted(rows.begin(), rows.end(), is_before)) {
    std::sort(rows.begin(), rows.end(), is_before);
  }
  add_covariances(database, run.header, rows);
  if (content == Content::trials_and_steps) {
    run.steps = StepReader(database, run.header, rows).read();
  }
  run.records.reserve(rows.size());
  for (auto& [index, record] : rows) {
    const auto& [variant, scene, sensor, trial] = index;
    record.id = {run.header.variants[variant].name, run.header.scenes[scene].name,
                 run.header.sensors[sensor].name, trial};
    run.records.push_back(std::move(record));
  }
  return run;
}

}  // namespace

void refuse_store(const fs::path& path) {
  try {
    throw;
  } catch (const InputError& error) {
    if (error.faults().size() == 1) throw;
    throw InputError({error.faults().front()});
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const nlohmann::json::exception&) {
    // The library's message names neither the file nor its content.
    throw InputError(path.string(), "", "is damaged: its JSON is not that of a store");
  } catch (const std::exception& error) {
    throw InputError(path.string(), "", std::string("is damaged: ") + error.what());
  }
}

Store::Store(const fs::path& path, const StoreHeader& header)
    : database_(open_store(path, header)),
      variants_(ids_of(database_, "variants")),
      scenes_(ids_of(database_, "scenes")),
      sensors_(ids_of(database_, "sensors")),
      inserter_(database_) {}

void Store::add(const std::vector<const TrialRecord*>& records) {
  Transaction transaction(database_);
  for (const TrialRecord* record : records) {
    const TrialId& id = record->id;
    inserter_.add(
        {variants_.at(id.variant), scenes_.at(id.scene), sensors_.at(id.sensor), id.trial},
        *record);
  }
  transaction.commit();
}

void Store::merge(const fs::path& shard, const StoreHeader& from) {
  refuse_differences(shard.string(), from, read_header(database_),
                     "only stores of the same experiment can be merged");
  const Attachment attachment(database_, shard, "shard");
  Transaction transaction(database_);
  database_.run(id_maps("shard"));
  for (const auto& [table, columns] : {StoredTable("trials", result_columns()),
                                       {"steps", kStepColumns},
                                       {"covariances", stored_covariance_columns()}}) {
    const std::string rows = with_main_ids("shard", table, columns);
    if (table != "steps") refuse_doubled(database_, shard, table, rows, columns);
    database_.run("INSERT OR IGNORE INTO main." + table + " " + rows);
  }
  transaction.commit();
}

StoreHeader stored_header(const fs::path& path) {
  if (!has_store(path)) return {};
  return reading(path, [&] {
    const Database database = open_to_read(path);
    check_content(database);
    check_rotations(database);
    check_covariances(database);
    check_diagnostics(database);
    return read_header(database);
  });
}

std::vector<TrialIndex> stored_trials(const fs::path& path, const StoreHeader& stored,
                                      const StoreHeader& header) {
  if (stored.provenance.empty()) return {};
  refuse_differences(path.string(), stored, header, kFreshRemedy);
  std::vector<TrialIndex> trials = reading(path, [&] { return trials_in(path, header); });
  std::sort(trials.begin(), trials.end());
  return trials;
}

StoredRun read_store(const fs::path& path, Content content) {
  return reading(path, [&] { return run_in(open_to_read(path), content); });
}

void rewrite_in_order(const fs::path& path) {
  if (is_in_order(open_to_read(path))) return;
  build_store(path, [&](Database& database) {
    const Attachment attachment(database, path, "old");
    Transaction transaction(database);
    database.run(copy_of_header("old") + id_maps("old") + "INSERT INTO main.trials " +
                 with_main_ids("old", "trials", result_columns()) +
                 " ORDER BY 1, 2, 3, 4; INSERT INTO main.steps " +
                 with_main_ids("old", "steps", kStepColumns) +
                 " ORDER BY 1, 2, 3, 4, 5; INSERT INTO main.covariances " +
                 with_main_ids("old", "covariances", stored_covariance_columns()) +
                 " ORDER BY 1, 2, 3, 4");
    transaction.commit();
  });
}

}  // namespace croon::experiments

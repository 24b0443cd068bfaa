#pragma once

#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <string>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "experiments/store/database.hpp"
#include "experiments/store/record_row.hpp"
#include "experiments/store/store_header.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {

/// The results of an experiment on disk, an SQLite file (docs/store.md): the trials as they are
/// done, without wall times. A trial that was added is there after a power loss. Not thread-safe.
/// Throws InputError where the file cannot be read or written, and where another process has it
/// open.
class Store {
 public:
  /// Opens the store `path`, or makes it, for trials of `header`. Throws InputError, saying what
  /// differs, where its trials come from something else.
  Store(const std::filesystem::path& path, const StoreHeader& header);

  /// Adds trials that are not there; they are on disk, all of them, when this returns.
  void add(const std::vector<const TrialRecord*>& records);
  /// Adds all trials of the store `shard`, whose header is `from`. Throws InputError where a trial
  /// that both have ended differently.
  void merge(const std::filesystem::path& shard, const StoreHeader& from);

 private:
  using Ids = std::map<std::string, std::int64_t>;
  Database database_;
  Ids variants_, scenes_, sensors_;
  RecordInserter inserter_;
};

/// The trials of `header` that the store `path` has, in order; none where there is no store. Throws
/// InputError, saying what differs, where its trials come from something else.
std::vector<TrialPlace> stored_places(const std::filesystem::path& path, const StoreHeader& header);

/// Does `work`, which reads what is in the store `path`. What is wrong in there is no bug of ours:
/// throws InputError.
template <class Work>
auto reading(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError(path.string(), "", std::string("is damaged: ") + error.what());
  }
}

/// A store as it is read for reports.
struct StoredRun {
  StoreHeader header;
  std::vector<TrialRecord> records;  ///< Of the header's names, in report order; without steps.
};

/// The header of the store `path`; without provenance where there is none.
StoreHeader stored_header(const std::filesystem::path& path);

/// The store `path`; of trials of which the experiment now has fewer, the first. Throws InputError
/// where there is none.
StoredRun read_store(const std::filesystem::path& path);

/// Writes the store `path`, which nobody may have open, anew in one order: stores of the same
/// trials become the same bytes, whatever the order in which they were added. Does nothing where it
/// is in order.
void rewrite_in_order(const std::filesystem::path& path);

/// Puts the store `by`, which nobody has open, in the place of the store `path`, if there is one:
/// at every moment one of them is there.
void replace_store(const std::filesystem::path& path, const std::filesystem::path& by);

/// The file and those that SQLite keeps beside it while it is open.
std::vector<std::filesystem::path> store_files(const std::filesystem::path& path);

}  // namespace croon::experiments

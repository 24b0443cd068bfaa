#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <string>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "experiments/store/store_file.hpp"
#include "experiments/store/store_header.hpp"
#include "experiments/store/trial_rows.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {

/// The results of an experiment on disk, an SQLite file (docs/store.md): the trials, without wall
/// times. An added trial survives a power loss. Not thread-safe. Throws InputError if the file
/// cannot be read or written, or if another process has it open.
class Store {
 public:
  /// Opens or creates the store `path` for trials of `header`. Throws InputError, naming the
  /// differences, if its trials were made from different inputs.
  Store(const std::filesystem::path& path, const StoreHeader& header);

  /// Adds trials that the store does not have. All are on disk when this returns.
  void add(const std::vector<const TrialRecord*>& records);
  /// Adds all trials of the store `shard`, whose `stored_header` is `from`. Throws InputError if a
  /// trial in both stores ended differently.
  void merge(const std::filesystem::path& shard, const StoreHeader& from);

 private:
  using Ids = std::map<std::string, std::int64_t>;
  Database database_;
  Ids variants_, scenes_, sensors_;
  RecordInserter inserter_;
};

/// The trials of `header` in the store `path`, in order; none if there is no store. `stored` is its
/// `stored_header`. Throws InputError, naming the differences, if its trials were made from
/// different inputs.
std::vector<TrialIndex> stored_trials(const std::filesystem::path& path, const StoreHeader& stored,
                                      const StoreHeader& header);

/// Rethrows the exception being handled as an InputError with one fault of the store `path`;
/// std::bad_alloc is rethrown unchanged.
[[noreturn]] void refuse_store(const std::filesystem::path& path);

/// Calls `work`, which reads the store `path`, and converts exceptions to InputErrors with one
/// fault: a damaged store is not a programming error, and users cannot correct individual faults.
template <class Work>
auto reading(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const std::exception&) {
    refuse_store(path);
  }
}

/// A number reported by a step of a trial.
struct StepNumber {
  std::uint32_t record = 0;  ///< Index in StoredRun::records.
  std::uint32_t step = 0;    ///< Index in StepNumbers::names, like `name`.
  std::uint32_t name = 0;
  double value = 0.0;  ///< May be infinite or NaN.
};

/// The numbers reported by all steps: by record, then in the order of the steps, then by name. Each
/// name is stored once.
struct StepNumbers {
  std::vector<std::string> names;
  std::vector<StepNumber> numbers;
};

/// The content of a store, for reports.
struct StoredRun {
  StoreHeader header;
  std::vector<TrialRecord>
      records;        ///< Trials of the current names, in report order, without steps.
  StepNumbers steps;  ///< Empty unless requested.
};

/// The content to read from a store.
enum class Content { trials, trials_and_steps };

/// The header of the store `path`; without provenance if there is no store. Checks the whole store
/// and throws InputError if it is damaged.
StoreHeader stored_header(const std::filesystem::path& path);

/// Reads the store `path`, without trials that the experiment no longer has. Throws InputError if
/// there is no store, or a damaged one.
StoredRun read_store(const std::filesystem::path& path, Content content = Content::trials);

/// Rewrites the store `path`, which must not be open, in report order: stores of the same trials
/// become identical bytes, regardless of the order in which the trials were added. Does nothing if
/// the store is in order.
void rewrite_in_order(const std::filesystem::path& path);

}  // namespace croon::experiments

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
/// times. A trial that was added survives a power loss. Not thread-safe. Throws InputError if the
/// file cannot be read or written, or if another process has it open.
class Store {
 public:
  /// Opens or creates the store `path` for trials of `header`. Throws InputError that names the
  /// differences if its trials were made from something else.
  Store(const std::filesystem::path& path, const StoreHeader& header);

  /// Adds trials that the store does not have. All of them are on disk when this returns.
  void add(const std::vector<const TrialRecord*>& records);
  /// Adds all trials of the store `shard`, whose `stored_header` is `from`. Throws InputError if a
  /// trial that both have ended differently.
  void merge(const std::filesystem::path& shard, const StoreHeader& from);

 private:
  using Ids = std::map<std::string, std::int64_t>;
  Database database_;
  Ids variants_, scenes_, sensors_;
  RecordInserter inserter_;
};

/// The trials of `header` that the store `path` has, in order; none if there is no store. `stored`
/// is its `stored_header`. Throws InputError that names the differences if its trials were made
/// from something else.
std::vector<TrialIndex> stored_trials(const std::filesystem::path& path, const StoreHeader& stored,
                                      const StoreHeader& header);

/// Throws the exception that is being handled again, as an InputError of one fault of the store
/// `path`; std::bad_alloc stays as it is.
[[noreturn]] void refuse_store(const std::filesystem::path& path);

/// Calls `work`, which reads the store `path`. Exceptions become InputErrors of one fault: a
/// damaged store is not a programming error, and the user cannot correct it part by part.
template <class Work>
auto reading(const std::filesystem::path& path, const Work& work) {
  try {
    return work();
  } catch (const std::exception&) {
    refuse_store(path);
  }
}

/// A number that a step of a trial reported of its work.
struct StepNumber {
  std::uint32_t record = 0;  ///< Index in StoredRun::records.
  std::uint32_t step = 0;    ///< Index in StepNumbers::names, and so is `name`.
  std::uint32_t name = 0;
  double value = 0.0;  ///< May be infinite or NaN.
};

/// The numbers of all steps: by record, then in the order of the steps, then by name. Each name is
/// kept once.
struct StepNumbers {
  std::vector<std::string> names;
  std::vector<StepNumber> numbers;
};

/// The content of a store, for reports.
struct StoredRun {
  StoreHeader header;
  std::vector<TrialRecord> records;  ///< Of the header's names, in report order; without steps.
  StepNumbers steps;                 ///< Empty unless they were asked for.
};

/// What is read of a store.
enum class Content { trials, trials_and_steps };

/// The header of the store `path`; without provenance if there is no store. Checks the whole store
/// and throws InputError if it is damaged.
StoreHeader stored_header(const std::filesystem::path& path);

/// Reads the store `path`, without trials that the experiment no longer has. Throws InputError if
/// there is no store, or a damaged one.
StoredRun read_store(const std::filesystem::path& path, Content content = Content::trials);

/// Rewrites the store `path`, which no one may have open, in report order: stores of the same
/// trials become the same bytes, whatever the order in which the trials were added. Does nothing if
/// the store is in order.
void rewrite_in_order(const std::filesystem::path& path);

}  // namespace croon::experiments

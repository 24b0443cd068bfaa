#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/run/trial_record.hpp"
#include "experiments/store/database.hpp"
#include "experiments/store/store_writer.hpp"

namespace croon::experiments {

/// The file of the wall times of a folder of results.
std::filesystem::path timings_path(const std::filesystem::path& folder);

/// The wall times of trials and of work done once per scene, in an SQLite file. Added rows survive
/// a kill of the process.
class TimingsStore {
 public:
  /// Opens the file `path` with Access::read or Access::write. If there is none, Access::write
  /// creates it, and Access::read opens an empty database in memory. Throws InputError if the file
  /// is damaged or not from croon.
  TimingsStore(const std::filesystem::path& path, Access access);

  /// Adds the rows of `batch`, all or none.
  void add(const std::vector<Done>& batch);
  /// Adds the rows of the file `other`, if it exists, that are missing here.
  void merge(const std::filesystem::path& other);

  bool is_empty() const;
  /// Whether there is a wall time of this trial.
  bool has(const TrialId& id);
  /// Calls `use` with the rows, sorted by trial, in the order of the steps. Rows with a name that
  /// is not `is_harmless` are skipped.
  void for_each(const std::function<void(const TimingRow&)>& use) const;

 private:
  Database database_;
  Statement find_;
};

}  // namespace croon::experiments

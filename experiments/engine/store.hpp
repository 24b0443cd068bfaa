#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "experiments/engine/database.hpp"
#include "experiments/engine/trial_record.hpp"

namespace croon::experiments {

/// What decides the results of a run, by name ("starts", "program"), as text or as a digest of it.
using Provenance = std::map<std::string, std::string>;

/// A trial as a key: variant, scene, sensor, trial.
using TrialKey = std::tuple<std::string, std::string, std::string, int>;

TrialKey trial_key(const TrialId& id);

/// The results of an experiment on disk, an SQLite file: each trial as it is done, without wall
/// times. A trial that was added is there after a power loss. Not thread-safe. Throws InputError
/// where the file cannot be read or written, and where another process has it open.
class Store {
 public:
  /// Opens the store `path`, or makes it. Throws InputError, saying what differs, where its trials
  /// come from something other than `provenance`: what is there and what would be added do not
  /// belong together.
  Store(const std::filesystem::path& path, const Provenance& provenance);

  /// The trials that are there.
  std::set<TrialKey> keys() const;
  /// All records, by variant, scene, sensor (as words) and trial; their steps' seconds are 0.
  std::vector<TrialRecord> records() const;
  /// Adds a trial that is not there; on disk when this returns.
  void add(const TrialRecord& record);

 private:
  Database database_;
  Statement insert_;
};

/// Writes the store `path`, which nobody may have open, anew in one order: stores of the same
/// trials become the same bytes, whatever the order in which they were added.
void rewrite_in_order(const std::filesystem::path& path);

/// The file and those that SQLite keeps beside it while it is open.
std::vector<std::filesystem::path> store_files(const std::filesystem::path& path);

}  // namespace croon::experiments

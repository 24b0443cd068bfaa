#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "experiments/analysis/results.hpp"
#include "experiments/store/store.hpp"
#include "framework/base/folder_lock.hpp"

namespace croon::experiments {

// The files of a folder of results.

/// File names used by several commands, and the name of the folder of clouds.
inline constexpr const char* kTimings = "timings.csv";
inline constexpr const char* kPicture = "before_after.png";
inline constexpr const char* kClouds = "clouds";

/// Whether `path`, which need not exist, belongs to the results of a run.
bool is_result_of_run(const std::filesystem::path& path);

/// The path of the store that a merge creates before it replaces the store of `folder`.
std::filesystem::path merged_store_path(const std::filesystem::path& folder);

/// The output folder of a run, created if missing and locked during the lifetime of this object.
class OutputFolder {
 public:
  /// Throws InputError if the folder cannot be created, written to or locked; if one of its files
  /// is a symbolic link, or a file modified in place has another hard link; and if the folder has
  /// neither a store nor a manifest of croon, but a file with the name of a result.
  explicit OutputFolder(const std::filesystem::path& path);

  std::filesystem::path store() const { return store_path(path_); }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }

  /// Deletes only the files that an earlier run left here.
  void clear() const;

  /// Writes the tables and pictures of `results`, and removes those of an earlier run that these
  /// results lack. If a table changes, the fused clouds and the picture from above are deleted,
  /// because they show other results. `manifest` are the bytes of manifest.json.
  void write_reports(const Results& results, const std::string& manifest) const;

 private:
  std::filesystem::path path_;
  FolderLock lock_;
};

/// timings.csv, extended while trials finish. When the file is opened again, an incomplete last
/// line is removed.
class TimingsFile {
 public:
  /// Throws InputError if the file cannot be written.
  explicit TimingsFile(const std::filesystem::path& path);

  void add(const std::vector<TimingRow>& rows);
  /// Writes the added rows to the file; they then survive a kill of the process.
  void flush();

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
  std::vector<TimingRow> rows_;  ///< Rows not yet written.
};

/// The last trials of a timings.csv, as named by `timed_trial`; empty if it cannot be read.
std::set<std::string> last_timed_trials(const std::filesystem::path& path);

/// The part of a row of timings.csv that identifies the trial.
std::string timed_trial(const TrialId& id);

/// The bytes of timings.csv of merged results: the rows of all `folders` that have the file,
/// without duplicates and malformed lines. Throws InputError if one of them is not a file.
std::string merged_timings(const std::vector<std::filesystem::path>& folders);

}  // namespace croon::experiments

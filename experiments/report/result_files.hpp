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

/// The names that more than one command knows; the clouds are a folder.
inline constexpr const char* kTimings = "timings.csv";
inline constexpr const char* kPicture = "before_after.png";
inline constexpr const char* kClouds = "clouds";

/// Whether `path`, which may be missing, is that of a file of the results of a run.
bool is_result_of_run(const std::filesystem::path& path);

/// The store that a merge makes before it replaces that of `folder`.
std::filesystem::path merged_store_path(const std::filesystem::path& folder);

/// The folder that a run writes into, made if it is missing and locked while this object lives.
class OutputFolder {
 public:
  /// Throws InputError if the folder cannot be made or written to, or another croon works in it;
  /// if one of the files is a symbolic link, or one that is changed in its place a hard link; and
  /// if the folder has neither a store nor a manifest
  /// of croon, but a file of a name that a run writes.
  explicit OutputFolder(const std::filesystem::path& path);

  std::filesystem::path store() const { return store_path(path_); }
  std::filesystem::path file(const char* name) const { return path_ / name; }

  /// Deletes the files that an earlier run left here, and nothing else.
  void clear() const;

  /// Writes the tables and the pictures of `results`, and removes those that an earlier run left
  /// and this one lacks. If a table changes, the fused clouds and the picture from above, which are
  /// of other results then, are deleted. `manifest` are the bytes of manifest.json.
  void write_reports(const Results& results, const std::string& manifest) const;

 private:
  std::filesystem::path path_;
  FolderLock lock_;
};

/// timings.csv, which grows as trials are done. When the file is opened again, a last line that a
/// kill cut off is removed.
class TimingsFile {
 public:
  /// Throws InputError if the file cannot be written.
  explicit TimingsFile(const std::filesystem::path& path);

  void add(const std::vector<TimingRow>& rows);
  /// Writes the rows that were added. After this they outlive a kill of the process.
  void flush();

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
  std::vector<TimingRow> rows_;  ///< Not yet written.
};

/// The last trials of a timings.csv, as `timed_trial` names them; none if it cannot be read.
std::set<std::string> last_timed_trials(const std::filesystem::path& path);

/// What a row of timings.csv says of which trial it is.
std::string timed_trial(const TrialId& id);

/// The bytes of timings.csv of merged results: the rows of all `folders` that have the file,
/// without duplicates and malformed lines. Throws InputError if one of them is not a file.
std::string merged_timings(const std::vector<std::filesystem::path>& folders);

}  // namespace croon::experiments

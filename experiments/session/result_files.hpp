#pragma once

#include <filesystem>
#include <string>

#include "experiments/analysis/results.hpp"
#include "experiments/store/store.hpp"
#include "experiments/store/timings_store.hpp"
#include "framework/base/folder_lock.hpp"

namespace croon::experiments {

// The files of a folder of results.

/// File names used by several commands, and the name of the folder of clouds.
inline constexpr const char* kPicture = "before_after.png";
inline constexpr const char* kClouds = "clouds";
inline constexpr const char* kReport = "report.html";

/// Whether `path`, which need not exist, belongs to the results of a run.
bool is_result_of_run(const std::filesystem::path& path);

/// The path of the store that a merge creates before it replaces the store of `folder`.
std::filesystem::path merged_store_path(const std::filesystem::path& folder);

/// A line if wall times of `folder` are only in timings.csv, which is never read; else empty.
std::string left_out_times_text(const std::filesystem::path& folder);

/// The output folder of a run, created if missing and locked during the lifetime of this object.
class OutputFolder {
 public:
  /// Throws InputError if the folder cannot be created, written to or locked; if one of its files
  /// is a symbolic link, or a file modified in place has another hard link; and if the folder has
  /// neither a store nor a manifest of croon, but a file with the name of a result.
  explicit OutputFolder(const std::filesystem::path& path);

  std::filesystem::path store() const { return store_path(path_); }
  std::filesystem::path timings() const { return timings_path(path_); }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }

  /// Deletes only the files that an earlier run left here.
  void clear() const;

  /// Writes the tables and pictures of `results`, and removes those of an earlier run that these
  /// results lack. If a table changes, the fused clouds and the picture from above are deleted,
  /// because they show other results. `manifest` are the bytes of manifest.json.
  void write_reports(const Results& results, const TimingsStore& timings,
                     const std::string& manifest) const;

 private:
  std::filesystem::path path_;
  FolderLock lock_;
};

}  // namespace croon::experiments

#pragma once

#include <filesystem>
#include <string>

#include "experiments/report/report_files.hpp"
#include "experiments/store/store.hpp"

namespace croon::experiments {

/// Locks a folder against other croon processes while this object lives; it need not be writable.
class FolderLock {
 public:
  /// Throws InputError if another croon works in the folder.
  explicit FolderLock(const std::filesystem::path& path);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int lock_ = -1;
};

/// The folder that a run writes into, made if it is missing and locked while this object lives.
class OutputFolder {
 public:
  /// Throws InputError if the folder cannot be made or written to, or another croon works in it.
  explicit OutputFolder(const std::filesystem::path& path);

  std::filesystem::path store() const { return store_path(path_); }
  std::filesystem::path timings() const { return path_ / kTimings; }
  std::filesystem::path clouds() const { return path_ / "clouds"; }
  std::filesystem::path file(const char* name) const { return path_ / name; }

  /// Deletes the files that an earlier run left here, and nothing else.
  void clear() const;

 private:
  std::filesystem::path path_;
  FolderLock lock_;
};

/// Writes `bytes` to the file `path`, whole or not at all. Throws InputError if it cannot be
/// written, and if it would replace `input`, which the bytes were made from, or a store.
void write_output_file(const std::filesystem::path& path, const std::string& bytes,
                       const std::filesystem::path& input);

}  // namespace croon::experiments

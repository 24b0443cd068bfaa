#pragma once

#include <filesystem>

namespace croon::experiments {

/// The files of a folder of results that more than one command knows.
inline constexpr const char* kTimings = "timings.csv";
inline constexpr const char* kPicture = "before_after.png";

/// Where a folder of results has its store.
std::filesystem::path store_path(const std::filesystem::path& folder);

/// Keeps a folder from other processes until this object goes; it need not be writable.
class FolderLock {
 public:
  /// Throws InputError where another croon is working in the folder.
  explicit FolderLock(const std::filesystem::path& path);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int lock_ = -1;
};

/// The folder that a run writes into, made where it is missing and kept from other processes until
/// this object goes.
class OutputFolder {
 public:
  /// Throws InputError where the folder cannot be made or written to, or another croon is working
  /// in it.
  explicit OutputFolder(const std::filesystem::path& path);

  std::filesystem::path store() const { return store_path(path_); }
  std::filesystem::path timings() const { return path_ / kTimings; }
  std::filesystem::path clouds() const { return path_ / "clouds"; }
  std::filesystem::path file(const char* name) const { return path_ / name; }

  /// Deletes what an earlier run left here, and nothing else.
  void clear() const;

 private:
  std::filesystem::path path_;
  FolderLock lock_;
};

}  // namespace croon::experiments

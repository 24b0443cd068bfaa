#pragma once

#include <filesystem>

namespace croon {

/// Locks a folder, which need not be writable, against other croon processes during its lifetime.
class FolderLock {
 public:
  /// Throws InputError if another croon process is using the folder.
  explicit FolderLock(const std::filesystem::path& path);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int lock_ = -1;
};

}  // namespace croon

#pragma once

#include <filesystem>

namespace croon {

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

}  // namespace croon

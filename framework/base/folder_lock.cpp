#include "framework/base/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "framework/base/error.hpp"

namespace croon {

FolderLock::FolderLock(const std::filesystem::path& path) {
  lock_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A file system that cannot lock folders is not an error: SQLite also locks the store.
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(lock_);
    throw InputError(path.string(), "", "another croon is working in this folder");
  }
}

FolderLock::~FolderLock() {
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace croon

#include "experiments/cli/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <vector>

#include "experiments/store/store.hpp"
#include "framework/base/error.hpp"

namespace croon::experiments {
namespace {

constexpr std::array<const char*, 12> kReports = {
    "loops.csv",    "trials.csv",          kTimings,         "summary.csv",
    "summary.json", "summary_by_kind.csv", "comparison.csv", "basin.csv",
    "basin.svg",    "box_plots.svg",       "manifest.json",  kPicture};

/// The folder, made where it is missing, if a run can write to it.
std::filesystem::path writable(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error || !std::filesystem::is_directory(path, error)) {
    throw InputError(path.string(), "", "expected a folder to write to: " + error.message());
  }
  if (::access(path.c_str(), W_OK | X_OK) != 0) {
    throw InputError(path.string(), "", "expected a folder that may be written to");
  }
  std::vector<std::filesystem::path> files = store_files(store_path(path));
  for (const char* name : kReports) files.push_back(path / name);
  for (const std::filesystem::path& to_write : files) {
    if (!std::filesystem::is_directory(to_write, error)) continue;
    throw InputError(to_write.string(), "", "expected a file or nothing, found a folder");
  }
  return path;
}

}  // namespace

std::filesystem::path store_path(const std::filesystem::path& folder) {
  return folder / "store.sqlite";
}

FolderLock::FolderLock(const std::filesystem::path& path) {
  lock_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // A file system that cannot lock folders is no fault: SQLite locks the store besides.
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    ::close(lock_);
    throw InputError(path.string(), "", "another croon is working in this folder");
  }
}

FolderLock::~FolderLock() {
  if (lock_ >= 0) ::close(lock_);
}

OutputFolder::OutputFolder(const std::filesystem::path& path)
    : path_(writable(path)), lock_(path_) {}

void OutputFolder::clear() const {
  std::vector<std::filesystem::path> old = store_files(store());
  for (const char* name : kReports) old.push_back(file(name));
  old.push_back(clouds());
  for (const std::filesystem::path& path : old) {
    std::error_code error;
    std::filesystem::remove_all(path, error);
    if (error) throw InputError(path.string(), "", "cannot be deleted: " + error.message());
  }
}

}  // namespace croon::experiments

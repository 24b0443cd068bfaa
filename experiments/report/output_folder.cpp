#include "experiments/report/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"

namespace croon::experiments {
namespace {

/// The folder, made if it is missing. Throws InputError if a run cannot write to it.
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
  for (const std::string& name : result_file_names()) files.push_back(path / name);
  for (const std::filesystem::path& to_write : files) {
    if (!std::filesystem::is_directory(to_write, error)) continue;
    throw InputError(to_write.string(), "", "expected a file or nothing, found a folder");
  }
  return path;
}

}  // namespace

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
  for (const std::string& name : result_file_names()) old.push_back(path_ / name);
  old.push_back(clouds());
  for (const std::filesystem::path& path : old) {
    std::error_code error;
    std::filesystem::remove_all(path, error);
    if (error) throw InputError(path.string(), "", "cannot be deleted: " + error.message());
  }
}

void write_output_file(const std::filesystem::path& path, const std::string& bytes,
                       const std::filesystem::path& input) {
  std::error_code error;
  const bool is_input = std::filesystem::equivalent(path, input, error);
  const bool is_store = path.filename() == store_path("").filename();
  if (is_input || (is_store && std::filesystem::exists(path, error))) {
    throw InputError("", "--out",
                     "expected a file to write, found " + path.string() + ", " +
                         (is_store ? "the store of a run" : "which is read"));
  }
  write_whole_file(path, bytes);
}

}  // namespace croon::experiments

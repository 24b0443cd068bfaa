#include "framework/base/whole_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "framework/base/error.hpp"
#include "framework/base/memory.hpp"
#include "framework/base/text.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

std::string reason(int number) { return std::strerror(number); }

/// Larger than any text and any sensor's cloud.
constexpr double kMaxFileBytes = 4e9;

/// Between the path and a number in the name of a temporary file.
constexpr const char* kPart = ".croon-part";

/// An empty file that is open for writing and locked.
struct PartFile {
  fs::path path;
  int descriptor;
};

/// Whether the open file is a regular one whose only name is still `path`: the process that had
/// locked it may have renamed it, and a file with a second name belongs to somebody else.
bool is_still(int descriptor, const fs::path& path) {
  struct stat open_file {};
  struct stat named {};
  return ::fstat(descriptor, &open_file) == 0 && ::lstat(path.c_str(), &named) == 0 &&
         S_ISREG(named.st_mode) && named.st_nlink == 1 && open_file.st_dev == named.st_dev &&
         open_file.st_ino == named.st_ino;
}

PartFile create_part_file(const fs::path& path) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    const fs::path part = path.string() + kPart + std::to_string(i);
    // A signal may interrupt the call on a network file system.
    const int descriptor = TEMP_FAILURE_RETRY(
        ::open(part.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666));
    if (descriptor < 0) {
      const int error = errno;
      struct stat something {};
      if (::lstat(part.c_str(), &something) == 0) continue;
      errno = error;
      break;
    }
    // A lock ends with its process, so an unlocked file is left over from a killed one.
    const bool is_ours = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    if (is_ours && is_still(descriptor, part) && ::ftruncate(descriptor, 0) == 0) {
      return {part, descriptor};
    }
    ::close(descriptor);
  }
  throw InputError(path.string(), "",
                   "expected a file that can be written, found: " + reason(errno));
}

/// Zero, or the error number.
int write_all(int descriptor, std::string_view bytes) {
  // Linux writes less than 2 GiB per call.
  constexpr std::size_t kMaxWriteBytes = std::size_t{1} << 30;
  while (!bytes.empty()) {
    const ssize_t written =
        ::write(descriptor, bytes.data(), std::min(bytes.size(), kMaxWriteBytes));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

std::string found_instead_of_file(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  if (fs::is_directory(status)) return "a folder";
  if (fs::exists(status)) return "something that is not a file";
  return fs::is_symlink(fs::symlink_status(path, none)) ? "a link that leads nowhere" : "none";
}

std::string read_whole_file(const fs::path& path) {
  std::error_code error;
  // Checked before opening, because opening a pipe would wait for a writer.
  if (!fs::is_regular_file(path, error)) {
    throw UnavailableFile(path.string(), "",
                          "expected a readable file, found " + found_instead_of_file(path));
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    throw UnavailableFile(path.string(), "", "expected a readable file, found one that is not");
  }
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw UnavailableFile(path.string(), "", "cannot be read: " + error.message());
  const double max_bytes = std::min(kMaxFileBytes, memory_limit_bytes());
  if (static_cast<double>(size) > max_bytes) {
    throw UnavailableFile(path.string(), "",
                          "expected a file of at most " + fixed_number(max_bytes, 0) +
                              " bytes, found one of " + std::to_string(size));
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) {
    throw UnavailableFile(path.string(), "", "became shorter while it was being read");
  }
  return bytes;
}

std::optional<std::string> read_file_if_there(const fs::path& path) {
  std::error_code error;
  if (fs::symlink_status(path, error).type() == fs::file_type::not_found) return std::nullopt;
  return read_whole_file(path);
}

bool file_begins_with(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error))) return false;
  std::string begin(bytes.size(), '\0');
  std::ifstream(path, std::ios::binary)
      .read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == bytes;
}

bool file_has(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  return file_begins_with(path, bytes) && fs::file_size(path, error) == bytes.size();
}

void write_whole_file(const fs::path& path, std::string_view bytes) {
  write_in_parts(path, [&](const auto& append) { append(bytes); });
}

void write_in_parts(
    const fs::path& path,
    const std::function<void(const std::function<void(std::string_view)>&)>& write) {
  std::error_code ignored;
  // Renaming onto a device or a pipe would replace it with a file.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    throw InputError(path.string(), "",
                     "expected a file that can be written, found " + found_instead_of_file(path));
  }
  const PartFile part = create_part_file(path);
  int error = 0;
  try {
    write([&](std::string_view bytes) {
      if (error == 0) error = write_all(part.descriptor, bytes);
    });
  } catch (...) {
    ::unlink(part.path.c_str());
    ::close(part.descriptor);
    throw;
  }
  if (error == 0 && ::fsync(part.descriptor) != 0) error = errno;
  // Renamed or removed while locked, so that no other process writes to it meanwhile.
  if (error == 0 && ::rename(part.path.c_str(), path.c_str()) != 0) error = errno;
  if (error != 0) ::unlink(part.path.c_str());
  if (::close(part.descriptor) != 0 && error == 0) error = errno;
  if (error == 0) return;
  throw InputError(path.string(), "", "cannot be written: " + reason(error));
}

void make_folder_below(const fs::path& root, const fs::path& relative) {
  fs::path folder = root;
  for (const fs::path& name : relative) {
    folder /= name;
    std::error_code error;
    if (fs::is_symlink(fs::symlink_status(folder, error))) {
      throw InputError(folder.string(), "", "expected a folder or nothing, found a symbolic link");
    }
    fs::create_directory(folder, error);
    if (error) throw InputError(folder.string(), "", "cannot be created: " + error.message());
  }
}

bool is_part_of(const fs::path& part, const fs::path& path) {
  const std::string begin = path.string() + kPart;
  return part.string().compare(0, begin.size(), begin) == 0;
}

}  // namespace croon

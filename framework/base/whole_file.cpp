#include "framework/base/whole_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "framework/base/error.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

std::string reason(int number) { return std::strerror(number); }

/// A file open for writing that did not exist before: `path.part0`, or the next number that is
/// free.
struct PartFile {
  fs::path path;
  int descriptor;
};

PartFile create_part_file(const fs::path& path) {
  constexpr int kTries = 1000;
  for (int i = 0; i < kTries; ++i) {
    const fs::path part = path.string() + ".part" + std::to_string(i);
    const int descriptor = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) return {part, descriptor};
    if (errno != EEXIST) break;
  }
  throw InputError(path.string(), "",
                   "expected a file that can be written, found: " + reason(errno));
}

/// Zero, or the number of the error.
int write_all(int descriptor, std::string_view bytes) {
  // Linux writes less than 2 GiB at a time.
  constexpr std::size_t kMost = std::size_t{1} << 30;
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), std::min(bytes.size(), kMost));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

std::string read_whole_file(const fs::path& path) {
  std::error_code error;
  // Before it is opened: opening a pipe would wait for a writer.
  if (!fs::is_regular_file(path, error)) {
    throw InputError(path.string(), "", "expected a readable file, found none");
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    throw InputError(path.string(), "", "expected a readable file, found one that is not");
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) throw InputError(path.string(), "", "cannot be read: " + error.message());
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::uintmax_t>(stream.gcount()) != size) {
    throw InputError(path.string(), "", "ended while it was read");
  }
  return bytes;
}

void write_whole_file(const fs::path& path, std::string_view bytes) {
  std::error_code ignored;
  // Renaming onto a device or a pipe would replace it by a file.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored)) {
    throw InputError(path.string(), "",
                     "expected a file that can be written, found something else");
  }
  const PartFile part = create_part_file(path);
  int error = write_all(part.descriptor, bytes);
  if (error == 0 && ::fsync(part.descriptor) != 0) error = errno;
  if (::close(part.descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && ::rename(part.path.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(part.path.c_str());
  throw InputError(path.string(), "", "cannot be written: " + reason(error));
}

}  // namespace croon

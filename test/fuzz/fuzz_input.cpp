#include "test/fuzz/fuzz_input.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "framework/base/error.hpp"
#include "framework/io/point_cloud_file.hpp"

namespace croon::fuzz {

namespace fs = std::filesystem;

namespace {

/// A folder that ends with the process, in memory if the system has such a file system.
class ProcessFolder {
 public:
  ProcessFolder() {
    const fs::path parent = fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
    path_ = parent / ("croon_fuzz_" + std::to_string(::getpid()));
    fs::create_directories(path_);
  }
  ~ProcessFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

}  // namespace

fs::path write_input(const std::string& name, const std::uint8_t* data, std::size_t size) {
  static const ProcessFolder folder;
  const fs::path path = folder.path() / name;
  fs::create_directories(path.parent_path());
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  stream.close();
  require(stream.good(), "the input cannot be written");
  return path;
}

bool is_taken(const std::function<void()>& read) {
  try {
    read();
    return true;
  } catch (const InputError& error) {
    require(!error.faults().empty(), "the error has no fault");
    for (const Fault& fault : error.faults()) {
      require(!fault.file.empty() && !fault.message.empty(), "the fault has no file or no message");
      // As the program prints it.
      require(fault.line().find('\n') == std::string::npos, "the fault is more than one line");
      require(fault.line().size() < 8192, "the fault is longer than a line that one reads");
    }
    return false;
  }
}

std::optional<LoadedCloud> read_cloud_input(const std::string& name, const std::uint8_t* data,
                                            std::size_t size) {
  const fs::path path = write_input(name, data, size);
  const bool header_is_taken = is_taken([&] { check_point_cloud_file(path); });
  LoadedCloud cloud;
  if (!is_taken([&] { cloud = read_point_cloud(path); })) return std::nullopt;
  require(header_is_taken, "the check of the header refuses what the reader takes");
  return cloud;
}

bool is_equal(const PointCloud& a, const PointCloud& b) {
  if (a.points != b.points || a.channels.size() != b.channels.size()) return false;
  for (std::size_t i = 0; i < a.channels.size(); ++i) {
    const Channel &one = a.channels[i], &two = b.channels[i];
    if (one.name != two.name || !(one.type == two.type) || one.count != two.count) return false;
    if (one.bytes.size() != two.bytes.size()) return false;
    for (std::size_t at = 0; at < one.bytes.size(); at += one.type.size) {
      const char *x = one.bytes.data() + at, *y = two.bytes.data() + at;
      const bool is_nan = std::isnan(decode_scalar(one.type, ByteOrder::little, x)) &&
                          std::isnan(decode_scalar(two.type, ByteOrder::little, y));
      if (!is_nan && std::memcmp(x, y, one.type.size) != 0) return false;
    }
  }
  return true;
}

void require(bool condition, const char* message) {
  if (condition) return;
  std::fprintf(stderr, "fuzz: %s\n", message);
  std::abort();
}

}  // namespace croon::fuzz

#include "framework/io/point_cloud_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <string>

#include "framework/base/error.hpp"
#include "framework/io/kitti_file.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/io/pcd_header.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/ply_header.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// One kind of point cloud file.
struct Format {
  const char* suffix;
  LoadedCloud (*read)(const fs::path& path);
  /// Takes the file's first bytes, its size and its name.
  void (*check)(std::string_view head, std::uint64_t file_bytes, const std::string& file);
};

void check_pcd(std::string_view head, std::uint64_t file_bytes, const std::string& file) {
  check_pcd_size(parse_pcd_header(head, file), head, file_bytes, file);
}

void check_ply(std::string_view head, std::uint64_t file_bytes, const std::string& file) {
  check_ply_size(parse_ply_header(head, file), file_bytes, file);
}

void check_kitti(std::string_view, std::uint64_t file_bytes, const std::string& file) {
  check_kitti_size(file_bytes, file);
}

const Format& format_of(const fs::path& path) {
  static const Format formats[] = {{".pcd", read_pcd, check_pcd},
                                   {".ply", read_ply, check_ply},
                                   {".bin", read_kitti, check_kitti}};
  std::string suffix = path.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Format& format : formats) {
    if (suffix == format.suffix) return format;
  }
  throw InputError(path.string(), "",
                   "expected a point cloud with the suffix .pcd, .ply or .bin, found \"" +
                       path.extension().string() + "\"");
}

/// The first bytes of a file: enough for a header and the sizes of a compressed body after it.
std::string head_of(const fs::path& path, std::uint64_t file_bytes) {
  const std::uint64_t wanted =
      std::min<std::uint64_t>(file_bytes, kMostHeaderBytes + kPcdSizesBytes);
  std::string head(static_cast<std::size_t>(wanted), '\0');
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(head.data(), static_cast<std::streamsize>(head.size()))) {
    throw InputError(path.string(), "", "expected a readable file, found one that is not");
  }
  return head;
}

}  // namespace

LoadedCloud read_point_cloud(const fs::path& path) { return format_of(path).read(path); }

void check_point_cloud_file(const fs::path& path) {
  const Format& format = format_of(path);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw InputError(path.string(), "", "expected a readable file, found none");
  }
  const std::uintmax_t file_bytes = fs::file_size(path, error);
  if (error) throw InputError(path.string(), "", "cannot be read: " + error.message());
  format.check(head_of(path, file_bytes), file_bytes, path.string());
}

}  // namespace croon

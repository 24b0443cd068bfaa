#include "framework/io/point_cloud_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <string>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/io/pcd_header.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/ply_header.hpp"
#include "framework/io/scalar_type.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// One format of point cloud files.
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

constexpr std::uint64_t kKittiRecordBytes = 16;

void check_kitti(std::string_view, std::uint64_t file_bytes, const std::string& file) {
  if (file_bytes % kKittiRecordBytes == 0) return;
  throw InputError(file, "",
                   "expected records of 16 bytes (x, y, z, intensity), found " +
                       std::to_string(file_bytes) + " bytes");
}

/// The points of a KITTI Velodyne file (Geiger et al. 2013): little-endian float32 x, y, z,
/// intensity, no header.
LoadedCloud read_kitti(const fs::path& path) {
  const std::string bytes = read_whole_file(path);
  check_kitti({}, bytes.size(), path.string());
  LoadedCloud cloud;
  cloud.points.reserve(bytes.size() / kKittiRecordBytes);
  const auto number = [&](std::size_t at) {
    return decode_scalar({ScalarKind::floating, 4}, ByteOrder::little, bytes.data() + at);
  };
  for (std::size_t record = 0; record < bytes.size(); record += kKittiRecordBytes) {
    cloud.add({number(record), number(record + 4), number(record + 8)});
  }
  return cloud;
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

#include "framework/io/point_cloud_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <string>

#include "framework/base/error.hpp"
#include "framework/base/memory.hpp"
#include "framework/base/scalar_type.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/io/pcd_header.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/ply_header.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// One format of point cloud files.
struct Format {
  const char* suffix;
  LoadedCloud (*parse)(std::string_view bytes, const std::string& file);
  /// Takes the file's first bytes, its size and its name. Returns the names of the channels.
  std::vector<std::string> (*check)(std::string_view head, std::uint64_t file_bytes,
                                    const std::string& file);
};

/// Without the empty ones.
std::vector<std::string> named(std::vector<std::string> names) {
  names.erase(std::remove(names.begin(), names.end(), ""), names.end());
  return names;
}

std::vector<std::string> check_pcd(std::string_view head, std::uint64_t file_bytes,
                                   const std::string& file) {
  const PcdHeader header = parse_pcd_header(head, file);
  check_pcd_size(header, head, file_bytes, file);
  if (header.encoding == PcdEncoding::binary_compressed) {
    // The file, what it expands to, and the points with their channels are in memory at one time.
    const auto point_bytes = static_cast<double>(header.point_bytes);
    const double points_bytes =
        static_cast<double>(header.points) * (2.0 * point_bytes + sizeof(Eigen::Vector3f));
    require_memory(static_cast<double>(file_bytes) + points_bytes, "to read this file",
                   "make it smaller", {file, "", ""});
  }
  return named(pcd_channel_names(header));
}

std::vector<std::string> check_ply(std::string_view head, std::uint64_t file_bytes,
                                   const std::string& file) {
  const PlyHeader header = parse_ply_header(head, file);
  check_ply_size(header, file_bytes, file);
  return named(ply_channel_names(header));
}

constexpr std::uint64_t kKittiRecordBytes = 16;

std::vector<std::string> check_kitti(std::string_view, std::uint64_t file_bytes,
                                     const std::string& file) {
  if (file_bytes % kKittiRecordBytes == 0) return {kIntensity};
  throw InputError(file, "",
                   "expected records of 16 bytes (x, y, z, intensity), found " +
                       std::to_string(file_bytes) + " bytes");
}

/// The points of a KITTI Velodyne file (Geiger et al. 2013): little-endian float32 x, y, z,
/// intensity, no header.
LoadedCloud parse_kitti(std::string_view bytes, const std::string& file) {
  check_kitti({}, bytes.size(), file);
  LoadedCloud cloud;
  cloud.points.reserve(bytes.size() / kKittiRecordBytes);
  const auto number = [&](std::size_t at) {
    return decode_scalar({ScalarKind::floating, 4}, ByteOrder::little, bytes.data() + at);
  };
  Channel intensity{kIntensity, scalar_type_of<float>(), 1, {}};
  for (std::size_t record = 0; record < bytes.size(); record += kKittiRecordBytes) {
    const bool is_kept = cloud.add({number(record), number(record + 4), number(record + 8)});
    if (is_kept) intensity.bytes.append(bytes, record + 12, 4);
  }
  cloud.channels.push_back(std::move(intensity));
  return cloud;
}

/// The format of the file `path`, or null.
const Format* find_format(const fs::path& path) {
  static const Format formats[] = {{".pcd", parse_pcd, check_pcd},
                                   {".ply", parse_ply, check_ply},
                                   {".bin", parse_kitti, check_kitti}};
  std::string suffix = path.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const Format& format : formats) {
    if (suffix == format.suffix) return &format;
  }
  return nullptr;
}

const Format& format_of(const fs::path& path) {
  if (const Format* format = find_format(path)) return *format;
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

LoadedCloud read_point_cloud(const fs::path& path) {
  const Format& format = format_of(path);
  const std::string bytes = read_whole_file(path);
  const std::string sha256 = sha256_of_text(bytes);
  try {
    LoadedCloud cloud = format.parse(bytes, path.string());
    cloud.sha256 = sha256;
    return cloud;
  } catch (const InputError& error) {
    throw DamagedCloud(error, sha256);
  }
}

bool has_point_cloud_suffix(const fs::path& path) { return find_format(path) != nullptr; }

std::vector<std::string> check_point_cloud_file(const fs::path& path) {
  const Format& format = format_of(path);
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw InputError(path.string(), "",
                     "expected a readable file, found " + found_instead_of_file(path));
  }
  const std::uintmax_t file_bytes = fs::file_size(path, error);
  if (error) throw InputError(path.string(), "", "cannot be read: " + error.message());
  // The bytes, the points and the channels are in memory at one time.
  constexpr double kMemoryPerByte = 2.25;
  require_memory(kMemoryPerByte * static_cast<double>(file_bytes), "to read this file",
                 "make it smaller", {path.string(), "", ""});
  return format.check(head_of(path, file_bytes), file_bytes, path.string());
}

}  // namespace croon

#include "framework/io/point_cloud_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>

#include "framework/base/error.hpp"
#include "framework/base/memory.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/common_offset.hpp"
#include "framework/io/digest.hpp"
#include "framework/io/float_rows.hpp"
#include "framework/io/foreign_formats.hpp"
#include "framework/io/npy_file.hpp"
#include "framework/io/npy_header.hpp"
#include "framework/io/pcd_file.hpp"
#include "framework/io/pcd_header.hpp"
#include "framework/io/ply_file.hpp"
#include "framework/io/ply_header.hpp"
#include "framework/io/text_cloud.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

namespace fs = std::filesystem;

/// The start of a file.
struct FileHead {
  std::string_view bytes;        ///< The first bytes.
  std::uint64_t file_bytes = 0;  ///< Of the whole file.
  std::string file;              ///< Its path.
  ReadOptions options;
};

/// One format of point cloud files.
struct Format {
  LoadedCloud (*parse)(std::string_view bytes, const std::string& file, const ReadOptions& options,
                       const Eigen::Vector3d& origin_m);
  /// Checks the header and returns the names of the channels.
  std::vector<std::string> (*check)(const FileHead& head);
};

/// The non-empty names.
std::vector<std::string> named(std::vector<std::string> names) {
  names.erase(std::remove(names.begin(), names.end(), ""), names.end());
  return names;
}

std::vector<std::string> check_pcd(const FileHead& head) {
  const PcdHeader header = parse_pcd_header(head.bytes, head.file);
  check_pcd_size(header, head.bytes, head.file_bytes, head.file);
  if (header.encoding == PcdEncoding::binary_compressed) {
    // The file, its decompressed data, and the points with their channels are in memory
    // simultaneously.
    const auto point_bytes = static_cast<double>(header.point_bytes);
    const double points_bytes =
        static_cast<double>(header.points) * (2.0 * point_bytes + sizeof(Eigen::Vector3f));
    require_memory(static_cast<double>(head.file_bytes) + points_bytes, "to read this file",
                   "make it smaller", {head.file, "", ""});
  }
  return named(pcd_channel_names(header));
}

std::vector<std::string> check_ply(const FileHead& head) {
  const PlyHeader header = parse_ply_header(head.bytes, head.file);
  check_ply_size(header, head.file_bytes, head.file);
  return named(ply_channel_names(header));
}

std::vector<std::string> check_npy(const FileHead& head) {
  const NpyHeader header = parse_npy_header(head.bytes, head.file);
  check_npy_size(header, head.file_bytes, head.file);
  return named(npy_channel_names(header));
}

/// Reads the whole file: the directory of the archive is at its end, and the array may be
/// compressed.
std::vector<std::string> check_npz(const FileHead& head) {
  const std::string array = npy_of_npz(read_whole_file(head.file), head.file);
  return check_npy({array, array.size(), head.file, {}});
}

std::vector<std::string> check_text(const FileHead& head) {
  return named(text_channel_names(text_layout(head.bytes, head.file)));
}

std::vector<std::string> check_floats(const FileHead& head) {
  return float_rows(head.bytes, head.file_bytes, head.file, head.options.columns).channels;
}

const Format kPcd = {
    [](std::string_view bytes, const std::string& file, const ReadOptions&,
       const Eigen::Vector3d& origin_m) { return parse_pcd(bytes, file, origin_m); },
    check_pcd};
const Format kPly = {
    [](std::string_view bytes, const std::string& file, const ReadOptions&,
       const Eigen::Vector3d& origin_m) { return parse_ply(bytes, file, origin_m); },
    check_ply};
const Format kNpy = {
    [](std::string_view bytes, const std::string& file, const ReadOptions&,
       const Eigen::Vector3d& origin_m) { return parse_npy(bytes, file, origin_m); },
    check_npy};
const Format kNpz = {[](std::string_view bytes, const std::string& file, const ReadOptions&,
                        const Eigen::Vector3d& origin_m) {
                       return parse_npy(npy_of_npz(bytes, file), file, origin_m);
                     },
                     check_npz};
const Format kText = {
    [](std::string_view bytes, const std::string& file, const ReadOptions&,
       const Eigen::Vector3d& origin_m) { return parse_text_cloud(bytes, file, origin_m); },
    check_text};
const Format kFloats = {[](std::string_view bytes, const std::string& file,
                           const ReadOptions& options, const Eigen::Vector3d& origin_m) {
                          return parse_float_rows(bytes, file, options.columns, origin_m);
                        },
                        check_floats};

std::string suffix_of(const fs::path& path) {
  std::string suffix = path.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix;
}

/// The format of files with this suffix, or null.
const Format* format_of_suffix(const std::string& suffix) {
  static const std::map<std::string, const Format*> formats = {
      {".pcd", &kPcd},  {".ply", &kPly},  {".bin", &kFloats}, {".npy", &kNpy},  {".npz", &kNpz},
      {".csv", &kText}, {".txt", &kText}, {".xyz", &kText},   {".asc", &kText}, {".pts", &kText}};
  const auto found = formats.find(suffix);
  return found == formats.end() ? nullptr : found->second;
}

/// The format of a file that begins with `head`, or null.
const Format* format_of_content(std::string_view head) {
  const auto begins_with = [&](std::string_view magic) {
    return head.substr(0, magic.size()) == magic;
  };
  if (begins_with("# .PCD") || begins_with("VERSION .") || begins_with("VERSION 0.")) return &kPcd;
  if (begins_with("ply\n") || begins_with("ply\r")) return &kPly;
  if (begins_with("\x93NUMPY")) return &kNpy;
  if (begins_with("PK\x03\x04")) return &kNpz;
  return nullptr;
}

const Format& format_of(const fs::path& path, std::string_view head) {
  if (const Format* format = format_of_content(head)) return *format;
  const std::string foreign = foreign_format(head, path);
  if (!foreign.empty()) {
    throw InputError(path.string(), "", "expected a point cloud, found " + foreign);
  }
  if (const Format* format = format_of_suffix(suffix_of(path))) return *format;
  throw InputError(path.string(), "",
                   "expected a point cloud with the suffix .pcd, .ply, .bin, .npy, .npz, .csv, "
                   ".txt, .xyz, .asc or .pts, found " +
                       in_quotes(path.extension().string()));
}

/// The first bytes of a file: enough for a header and the sizes of a compressed body.
std::string head_of(const fs::path& path, std::uint64_t file_bytes) {
  const std::uint64_t wanted =
      std::min<std::uint64_t>(file_bytes, kMaxHeaderBytes + kPcdSizesBytes);
  std::string head(static_cast<std::size_t>(wanted), '\0');
  std::ifstream stream(path, std::ios::binary);
  if (!stream.read(head.data(), static_cast<std::streamsize>(head.size()))) {
    throw InputError(path.string(), "", "expected a readable file, found an unreadable one");
  }
  return head;
}

}  // namespace

LoadedCloud read_point_cloud(const fs::path& path, const ReadOptions& options) {
  const std::string bytes = read_whole_file(path);
  const Format& format = format_of(path, bytes);
  const std::string sha256 = sha256_of_text(bytes);
  try {
    LoadedCloud cloud = without_common_offset([&](const Eigen::Vector3d& origin_m) {
      return format.parse(bytes, path.string(), options, origin_m);
    });
    check_unit_of_times(cloud);
    cloud.sha256 = sha256;
    return cloud;
  } catch (const InputError& error) {
    throw DamagedCloud(error, sha256);
  }
}

bool has_point_cloud_suffix(const fs::path& path) {
  const Format* format = format_of_suffix(suffix_of(path));
  return format != nullptr && suffix_of(path) != ".csv" && suffix_of(path) != ".txt";
}

bool looks_like_point_cloud(const fs::path& path) {
  if (has_point_cloud_suffix(path)) return true;
  std::error_code error;
  if (format_of_suffix(suffix_of(path)) == nullptr || !fs::is_regular_file(path, error)) {
    return false;
  }
  const std::uintmax_t file_bytes = fs::file_size(path, error);
  return !error && is_text_cloud(head_of(path, file_bytes));
}

std::vector<std::string> check_point_cloud_file(const fs::path& path, const ReadOptions& options) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw InputError(path.string(), "",
                     "expected a readable file, found " + found_instead_of_file(path));
  }
  const std::uintmax_t file_bytes = fs::file_size(path, error);
  if (error) throw InputError(path.string(), "", "cannot be read: " + error.message());
  // The bytes, the points and the channels are in memory simultaneously.
  constexpr double kMemoryPerByte = 2.25;
  require_memory(kMemoryPerByte * static_cast<double>(file_bytes), "to read this file",
                 "make it smaller", {path.string(), "", ""});
  const std::string head = head_of(path, file_bytes);
  return format_of(path, head).check({head, file_bytes, path.string(), options});
}

}  // namespace croon

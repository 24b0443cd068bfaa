#include "framework/io/kitti_file.hpp"

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/scalar_type.hpp"

namespace croon {
namespace {

constexpr std::uint64_t kRecordBytes = 16;

}  // namespace

void check_kitti_size(std::uint64_t file_bytes, const std::string& file) {
  if (file_bytes % kRecordBytes == 0) return;
  throw InputError(file, "",
                   "expected records of 16 bytes (x, y, z, intensity), found " +
                       std::to_string(file_bytes) + " bytes");
}

LoadedCloud read_kitti(const std::filesystem::path& path) {
  const std::string bytes = read_whole_file(path);
  check_kitti_size(bytes.size(), path.string());
  LoadedCloud cloud;
  cloud.points.reserve(bytes.size() / kRecordBytes);
  const auto number = [&](std::size_t at) {
    return decode_scalar({ScalarKind::floating, 4}, ByteOrder::little, bytes.data() + at);
  };
  for (std::size_t record = 0; record < bytes.size(); record += kRecordBytes) {
    cloud.add({number(record), number(record + 4), number(record + 8)});
  }
  return cloud;
}

}  // namespace croon

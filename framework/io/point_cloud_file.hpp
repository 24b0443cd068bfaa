#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The bytes of a file are no cloud of its format.
class DamagedCloud : public InputError {
 public:
  DamagedCloud(const InputError& error, std::string sha256)
      : InputError(error), sha256_(std::move(sha256)) {}

  /// Of the bytes that were read.
  const std::string& sha256() const { return sha256_; }

 private:
  std::string sha256_;
};

/// The cloud in a file, by its suffix (in any case): .pcd, .ply, or .bin as KITTI writes it; with
/// its channels and the digest of the bytes that were parsed. Throws InputError for another suffix,
/// UnavailableFile if the file cannot be read, and DamagedCloud if its bytes are damaged.
LoadedCloud read_point_cloud(const std::filesystem::path& path);

/// Whether `path` has the suffix of a format that `read_point_cloud` reads.
bool has_point_cloud_suffix(const std::filesystem::path& path);

/// Checks only the header and the size of the file. Throws InputError if they already show that
/// read_point_cloud would fail: no file, an unknown format, no x, y, z, too few bytes. Returns the
/// names of the channels.
std::vector<std::string> check_point_cloud_file(const std::filesystem::path& path);

}  // namespace croon

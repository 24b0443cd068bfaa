#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The bytes of a file are not a valid cloud of its format.
class DamagedCloud : public InputError {
 public:
  DamagedCloud(const InputError& error, std::string sha256)
      : InputError(error), sha256_(std::move(sha256)) {}

  /// Of the bytes that were read.
  const std::string& sha256() const { return sha256_; }

 private:
  std::string sha256_;
};

/// Information that a file does not contain.
struct ReadOptions {
  /// Number of floats per point of a .bin file; 0 to determine it from the content (see
  /// `float_rows`).
  std::size_t columns = 0;
};

/// Reads the cloud in a file: PCD, PLY, NumPy (.npy, .npz), text (.csv, .txt, .xyz, .asc, .pts), or
/// rows of floats (.bin of KITTI, .pcd.bin of nuScenes); the first bytes take precedence over the
/// suffix. Returns it with its channels, notes and the digest of the parsed bytes. Throws
/// InputError for another format, with a way to convert it if known, UnavailableFile if the file
/// cannot be read, and DamagedCloud if its bytes are invalid.
LoadedCloud read_point_cloud(const std::filesystem::path& path, const ReadOptions& options = {});

/// Whether `path` has a suffix that only clouds have, unlike .csv and .txt.
bool has_point_cloud_suffix(const std::filesystem::path& path);

/// Whether a file in a folder counts as a cloud: it has the suffix of a cloud, or it is a .csv or
/// .txt file that begins like a cloud.
bool looks_like_point_cloud(const std::filesystem::path& path);

/// Checks only the header and the size of a file, and returns the names of its channels. Throws
/// InputError if read_point_cloud would certainly fail: no file, an unknown format, no x, y, z, too
/// few bytes.
std::vector<std::string> check_point_cloud_file(const std::filesystem::path& path,
                                                const ReadOptions& options = {});

}  // namespace croon

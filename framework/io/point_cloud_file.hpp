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

/// What a file does not say about itself.
struct ReadOptions {
  /// The number of floats per point of a .bin file; 0 to find it out (see `float_rows`).
  std::size_t columns = 0;
};

/// The cloud in a file: PCD, PLY, NumPy (.npy, .npz), text (.csv, .txt, .xyz, .asc, .pts), or rows
/// of floats (.bin of KITTI, .pcd.bin of nuScenes); the first bytes count before the suffix. With
/// its channels, its notes and the digest of the bytes that were parsed. Throws InputError, with
/// the way to convert the file where it is known, for another format, UnavailableFile if the file
/// cannot be read, and DamagedCloud if its bytes are damaged.
LoadedCloud read_point_cloud(const std::filesystem::path& path, const ReadOptions& options = {});

/// Whether `path` has the suffix of clouds alone: not .csv or .txt, which are text of any kind.
bool has_point_cloud_suffix(const std::filesystem::path& path);

/// Whether the file is to be taken for a cloud in a folder of files: its suffix says so, or it is a
/// .csv or .txt file that begins like a cloud.
bool looks_like_point_cloud(const std::filesystem::path& path);

/// Checks only the header and the size of the file. Throws InputError if they already show that
/// read_point_cloud would fail: no file, an unknown format, no x, y, z, too few bytes. Returns the
/// names of the channels.
std::vector<std::string> check_point_cloud_file(const std::filesystem::path& path,
                                                const ReadOptions& options = {});

}  // namespace croon

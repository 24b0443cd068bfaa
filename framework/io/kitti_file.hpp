#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "framework/geometry/loaded_cloud.hpp"

namespace croon {

/// The points of a KITTI Velodyne file (Geiger et al. 2013): little-endian float32 x, y, z,
/// intensity, no header.
LoadedCloud read_kitti(const std::filesystem::path& path);

/// Throws InputError where a file of `file_bytes` bytes is not a whole number of records.
void check_kitti_size(std::uint64_t file_bytes, const std::string& file);

}  // namespace croon

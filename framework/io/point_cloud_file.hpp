#pragma once

#include <filesystem>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The cloud in a file, by its suffix (in any case): .pcd, .ply, or .bin as KITTI writes it. Throws
/// InputError for another suffix and for a damaged file.
LoadedCloud read_point_cloud(const std::filesystem::path& path);

/// Checks only the header and the size of the file. Throws InputError if they already show that
/// read_point_cloud would fail: no file, an unknown format, no x, y, z, too few bytes.
void check_point_cloud_file(const std::filesystem::path& path);

}  // namespace croon

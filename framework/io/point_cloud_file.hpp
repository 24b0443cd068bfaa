#pragma once

#include <filesystem>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The cloud in a file, by its suffix (in any case): .pcd, .ply, or .bin as KITTI writes it. Throws
/// InputError for another suffix and where the file is not what it says.
LoadedCloud read_point_cloud(const std::filesystem::path& path);

/// Looks at the file's header and size alone, in no time, and throws InputError where they already
/// tell that read_point_cloud would fail: not there, no such format, no x, y, z, shorter than it
/// says.
void check_point_cloud_file(const std::filesystem::path& path);

}  // namespace croon

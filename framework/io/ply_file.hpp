#pragma once

#include <filesystem>

#include "framework/geometry/loaded_cloud.hpp"

namespace croon {

/// The vertices of a PLY file (ascii or binary of either byte order; x, y, z of any type and in any
/// order; other properties, lists and elements are skipped). Throws InputError where the file is
/// not what its header says.
LoadedCloud read_ply(const std::filesystem::path& path);

}  // namespace croon

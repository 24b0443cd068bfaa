#pragma once

#include <filesystem>

#include "framework/geometry/loaded_cloud.hpp"

namespace croon {

/// The points of a PCD file (versions .5 to .7; ascii, binary, binary_compressed; x, y, z of any
/// type and in any order; other fields are skipped). VIEWPOINT is ignored: points are taken in the
/// sensor's frame as they are stored. Throws InputError where the file is not what its header says.
LoadedCloud read_pcd(const std::filesystem::path& path);

}  // namespace croon

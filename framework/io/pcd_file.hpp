#pragma once

#include <filesystem>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The points of a PCD file (versions .5 to .7; ascii, binary, binary_compressed; x, y, z of any
/// type and in any order; other fields are skipped). VIEWPOINT is ignored: the points are in the
/// sensor's frame as they are stored. Throws InputError if the file contradicts its header.
LoadedCloud read_pcd(const std::filesystem::path& path);

/// Writes a cloud as binary PCD with the fields `x y z intensity ring timestamp` (F4 F4 F4 F4 U2
/// F8, as the real samples have them). Throws InputError if the file cannot be written.
void write_pcd(const std::filesystem::path& path, const MeasuredCloud& cloud);

}  // namespace croon

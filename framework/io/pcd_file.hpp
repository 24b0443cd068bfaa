#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The points of `bytes`, a PCD file (versions .5 to .7; ascii, binary, binary_compressed; x, y, z
/// of any type and in any order; other fields are skipped). VIEWPOINT is ignored: the points are in
/// the sensor's frame as they are stored. `file` is the name in errors. Throws InputError if the
/// body contradicts the header.
LoadedCloud parse_pcd(std::string_view bytes, const std::string& file);

/// Writes a cloud as binary PCD with the fields `x y z intensity ring timestamp` (F4 F4 F4 F4 U2
/// F8, as the real samples have them). Throws InputError if the file cannot be written.
void write_pcd(const std::filesystem::path& path, const MeasuredCloud& cloud);

}  // namespace croon

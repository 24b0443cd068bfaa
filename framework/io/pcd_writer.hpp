#pragma once

#include <filesystem>

#include "framework/geometry/measured_cloud.hpp"

namespace croon {

/// Writes a cloud as binary PCD with the fields `x y z intensity ring timestamp` (F4 F4 F4 F4 U2
/// F8, as the real samples have them). Throws InputError where the file cannot be written.
void write_pcd(const std::filesystem::path& path, const MeasuredCloud& cloud);

}  // namespace croon

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "framework/geometry/point_cloud.hpp"
#include "framework/io/pcd_header.hpp"

namespace croon {

/// Parses the points in `bytes`, a PCD file (versions .5 to .7; ascii, binary, binary_compressed;
/// x, y, z or X, Y, Z of any type and in any order), with its other fields as channels. VIEWPOINT
/// is not applied: points are used as stored, in the sensor's frame; a note says so unless it is
/// the identity. `file` is the name in errors, `origin_m` is subtracted. Throws InputError if the
/// body contradicts the header.
LoadedCloud parse_pcd(std::string_view bytes, const std::string& file,
                      const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero());

/// Writes a cloud with its channels as PCD: the fields x, y, z (F4), then one field per channel in
/// its type; `time` is written as `timestamp`, as in the real samples. Reading the file back yields
/// bitwise the same cloud. Throws InputError if the file cannot be written.
void write_pcd(const std::filesystem::path& path, const PointCloud& cloud,
               PcdEncoding encoding = PcdEncoding::binary);

}  // namespace croon

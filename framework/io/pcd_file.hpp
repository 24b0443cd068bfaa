#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "framework/geometry/point_cloud.hpp"
#include "framework/io/pcd_header.hpp"

namespace croon {

/// The points of `bytes`, a PCD file (versions .5 to .7; ascii, binary, binary_compressed; x, y, z
/// or X, Y, Z of any type and in any order), with its other fields as channels. VIEWPOINT is not
/// applied: the points are in the sensor's frame as they are stored; a note says so unless it is
/// the identity. `file` is the name in errors, `origin_m` is subtracted. Throws InputError if the
/// body contradicts the header.
LoadedCloud parse_pcd(std::string_view bytes, const std::string& file,
                      const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero());

/// Writes a cloud with its channels as PCD: the fields x, y, z (F4), then a field per channel in
/// its type; `time` is called `timestamp`, as in the real samples. What is read back is the same
/// cloud to the last byte. Throws InputError if the file cannot be written.
void write_pcd(const std::filesystem::path& path, const PointCloud& cloud,
               PcdEncoding encoding = PcdEncoding::binary);

}  // namespace croon

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/picture/colour.hpp"

namespace croon {

/// Parses the vertices in `bytes`, a PLY file (ascii or binary in either byte order; x, y, z or X,
/// Y, Z of any type and in any order), with their other numbers as channels; lists and other
/// elements are skipped. `file` is the name in errors, `origin_m` is subtracted. Throws InputError
/// if the body contradicts the header.
LoadedCloud parse_ply(std::string_view bytes, const std::string& file,
                      const Eigen::Vector3d& origin_m = Eigen::Vector3d::Zero());

/// The number format of write_ply.
enum class PlyFormat { binary_little_endian, ascii };

/// Writes a cloud as PLY with x, y, z and its channels; `time` is written as `timestamp`, as in
/// PCD. Ascii numbers are the shortest that read back bitwise equal. Throws InputError if the file
/// cannot be written, and for a channel that PLY does not support: 8-byte integers, or several
/// numbers per point.
void write_ply(const std::filesystem::path& path, const PointCloud& cloud,
               PlyFormat format = PlyFormat::binary_little_endian);

/// Writes all clouds of a rig in the reference's frame into one PLY, each in the colour of its
/// index in `clouds`; comments in the header name the sensors and their colours.
void write_fused_ply(const std::filesystem::path& path, const std::vector<ColouredCloud>& clouds);

/// Whether `path` is a file, not a link, that `write_fused_ply` wrote.
bool is_fused_ply(const std::filesystem::path& path);

}  // namespace croon

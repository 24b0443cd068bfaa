#pragma once

#include <filesystem>
#include <vector>

#include "framework/picture/coloured_cloud.hpp"

namespace croon {

enum class PlyFormat { binary_little_endian, ascii };

/// Writes a cloud as PLY with x, y, z; ascii numbers are the shortest that read back as the same
/// floats. Throws InputError where the file cannot be written.
void write_ply(const std::filesystem::path& path, const PointCloud& cloud,
               PlyFormat format = PlyFormat::binary_little_endian);

/// Writes all clouds of a rig in the reference's frame into one PLY, each in the colour of its
/// place in `clouds`; comments in the header say which is which.
void write_fused_ply(const std::filesystem::path& path, const std::vector<ColouredCloud>& clouds);

}  // namespace croon

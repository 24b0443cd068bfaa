#pragma once

#include <filesystem>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Writes the leaves of LeafGrid that contain a point as the active voxels of an OpenVDB grid of
/// bools, "occupancy", in the points' frame: voxel (i, j, k) coincides with leaf (i, j, k). The
/// same points yield the same bytes. Throws InputError if the file cannot be written, StageError if
/// a point is out of LeafGrid's range.
void write_occupancy_vdb(const std::filesystem::path& path, const Points& points,
                         double leaf_size_m);

}  // namespace croon

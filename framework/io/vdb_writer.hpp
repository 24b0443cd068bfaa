#pragma once

#include <filesystem>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Writes the leaves of LeafGrid that hold a point as the active voxels of an OpenVDB grid of
/// bools, "occupancy", in the points' frame: voxel (i, j, k) is drawn where leaf (i, j, k) is. The
/// same points give the same bytes. Throws InputError if the file cannot be written, StageError
/// if LeafGrid refuses a point.
void write_occupancy_vdb(const std::filesystem::path& path, const Points& points,
                         double leaf_size_m);

}  // namespace croon

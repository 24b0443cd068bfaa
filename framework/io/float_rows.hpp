#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The columns of a headerless file with rows of little-endian float32: x, y, z, then one channel
/// per column.
struct FloatRows {
  std::size_t columns = 4;
  std::vector<std::string> channels;
};

/// Determines the columns of `file`, which has `file_bytes` bytes and begins with `head`. KITTI has
/// 4 (Geiger et al. 2013: intensity), nuScenes 5 (intensity and ring; suffix .pcd.bin); 3 to 8 are
/// distinguished by content, since numbers within a column are more similar than across columns.
/// `columns` sets their number unless it is zero. Throws InputError if the file does not have a
/// whole number of rows, if the number of columns is ambiguous, or if the coordinates are
/// implausible for a scan.
FloatRows float_rows(std::string_view head, std::uint64_t file_bytes, const std::string& file,
                     std::size_t columns = 0);

/// Parses the points of such a file. Throws InputError like `float_rows`.
LoadedCloud parse_float_rows(std::string_view bytes, const std::string& file, std::size_t columns,
                             const Eigen::Vector3d& origin_m);

/// The name of the channel in column `column` (3 is the fourth) of unnamed rows of `columns`
/// numbers: "intensity" for the fourth of 4 or 5, otherwise "column_6".
std::string name_of_column(std::size_t column, std::size_t columns);

}  // namespace croon

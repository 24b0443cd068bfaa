#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The columns of a file of rows of little-endian float32 without a header: x, y, z, and a channel
/// in each column after them.
struct FloatRows {
  std::size_t columns = 4;
  std::vector<std::string> channels;
};

/// The columns of the file `file` of `file_bytes` bytes that begins with `head`. KITTI has 4
/// (Geiger et al. 2013: intensity), nuScenes 5 (intensity and ring; suffix .pcd.bin); 3 to 8 are
/// told apart by their content: numbers of one column are more alike than those of different ones.
/// `columns`, if not zero, is their number. Throws InputError if the file has no whole number of
/// rows, if its content does not show how many columns there are, or if the coordinates are not
/// those of a scan.
FloatRows float_rows(std::string_view head, std::uint64_t file_bytes, const std::string& file,
                     std::size_t columns = 0);

/// The points of such a file. Throws InputError like `float_rows`.
LoadedCloud parse_float_rows(std::string_view bytes, const std::string& file, std::size_t columns,
                             const Eigen::Vector3d& origin_m);

/// The channel in column `column` (3 is the fourth) of rows of `columns` numbers without names:
/// "intensity" in the fourth of 4 or 5, else "column_6".
std::string name_of_column(std::size_t column, std::size_t columns);

}  // namespace croon

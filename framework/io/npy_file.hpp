#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Parses the points in `bytes`, a NumPy array (.npy): N×3 or more numbers (x, y, z, intensity,
/// ...) in C or Fortran order, an image H×W×3 or more, or a structured array with fields x, y, z,
/// whose other fields are channels. `file` is the name in errors, `origin_m` is subtracted. Throws
/// InputError if the array has another shape or type, or if the body contradicts the header.
LoadedCloud parse_npy(std::string_view bytes, const std::string& file,
                      const Eigen::Vector3d& origin_m);

/// Extracts the array of points from `bytes`, an archive of NumPy arrays (.npz), as a .npy file:
/// the one named "points" or "xyz", or the only one. Throws InputError, with the existing names, if
/// there is none or the choice is ambiguous.
std::string npy_of_npz(std::string_view bytes, const std::string& file);

}  // namespace croon

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The points of `bytes`, a NumPy array (.npy): N×3 or more numbers (x, y, z, intensity, ...) in C
/// or Fortran order, an image H×W×3 or more, or a structured array with fields x, y, z, whose other
/// fields are channels. `file` is the name in errors, `origin_m` is subtracted. Throws InputError
/// if the array is another one or the body contradicts the header.
LoadedCloud parse_npy(std::string_view bytes, const std::string& file,
                      const Eigen::Vector3d& origin_m);

/// The array of points in `bytes`, an archive of NumPy arrays (.npz), as a .npy file: the one
/// called "points" or "xyz", or the only one. Throws InputError, with the names that there are, if
/// there is none or it is not clear which.
std::string npy_of_npz(std::string_view bytes, const std::string& file);

}  // namespace croon

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/scalar_type.hpp"

namespace croon {

/// The position of the numbers of one field of an array: the first is `first_byte` bytes after the
/// header, with `stride` bytes from one point to the next.
struct NpyField {
  std::string name;  ///< As in the file; "x", "y", "z", "intensity", ... for arrays without fields.
  ScalarType type;
  ByteOrder order = ByteOrder::little;
  std::uint64_t count = 1;
  std::uint64_t first_byte = 0;
  std::uint64_t stride = 0;
};

/// The header of a NumPy array of points, checked to be complete: N×3 or more numbers in C or
/// Fortran order, an image H×W×3 or more in C order, or a structured array of any shape.
struct NpyHeader {
  std::vector<NpyField> fields;
  std::array<std::size_t, 3> xyz{};  ///< Indices of the fields x, y, z or X, Y, Z.
  std::uint64_t points = 0;
  std::uint64_t data_bytes = 0;  ///< Of all numbers.
  std::size_t body_offset = 0;   ///< Bytes before the numbers.
};

/// Reads the header at the start of `bytes` (format versions 1 to 3); `file` is the name in errors.
/// Throws InputError, with a remedy, for an array of another shape or type.
NpyHeader parse_npy_header(std::string_view bytes, const std::string& file);

/// The name of the channel in each field, see `channel_names`.
std::vector<std::string> npy_channel_names(const NpyHeader& header);

/// Throws InputError unless a file of `file_bytes` bytes contains the numbers that its header
/// declares.
void check_npy_size(const NpyHeader& header, std::uint64_t file_bytes, const std::string& file);

}  // namespace croon

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/scalar_type.hpp"

namespace croon {

/// One property of a PLY element: a number, or a list of numbers if `list_count`, the type of the
/// list's length, is set.
struct PlyProperty {
  std::string name;
  ScalarType type;
  std::optional<ScalarType> list_count;
};

/// One element of a PLY file: "vertex", "face", ...
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { ascii, binary_little_endian, binary_big_endian };

/// The header of a PLY file, checked to be complete and consistent.
struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t vertex = 0;            ///< Index of the element "vertex".
  std::array<std::size_t, 3> xyz{};  ///< Indices of its properties x, y, z or X, Y, Z.
  std::size_t body_offset = 0;       ///< Bytes before the elements.
  int lines = 0;                     ///< Lines before the elements.
};

/// Reads the header at the start of `bytes`; `file` is the name in errors. Throws InputError with
/// the faulty line and the reason.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& file);

/// The name of the channel in each property of the vertices, see `channel_names`; empty for lists.
std::vector<std::string> ply_channel_names(const PlyHeader& header);

/// The name of a type in a header, such as "float"; empty for 8-byte integers, which PLY does not
/// support.
std::string ply_type_name(ScalarType type);

/// Throws InputError if a file of `file_bytes` bytes cannot contain the elements that its header
/// declares.
void check_ply_size(const PlyHeader& header, std::uint64_t file_bytes, const std::string& file);

}  // namespace croon

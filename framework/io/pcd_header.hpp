#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/scalar_type.hpp"

namespace croon {

/// One field of a PCD file's points: `count` numbers of one type.
struct PcdField {
  std::string name;
  ScalarType type;
  std::uint64_t count = 1;
  std::uint64_t first_byte = 0;  ///< Offset in a point, bytes.
  std::uint64_t first_word = 0;  ///< Offset in a line of text, words.
};

enum class PcdEncoding { ascii, binary, binary_compressed };

/// The header of a PCD file (versions .5 to .7), checked to be complete and consistent.
struct PcdHeader {
  std::vector<PcdField> fields;
  std::array<std::size_t, 3> xyz{};  ///< Indices of the fields x, y, z or X, Y, Z.
  std::uint64_t points = 0;
  std::uint64_t point_bytes = 0;
  std::uint64_t point_words = 0;
  PcdEncoding encoding = PcdEncoding::ascii;
  std::size_t body_offset = 0;  ///< Bytes before the points.
  int lines = 0;                ///< Lines before the points.
  std::string viewpoint;        ///< The words of VIEWPOINT; empty if it is the identity.
};

/// Reads the header at the start of `bytes`; `file` is the name in errors. Throws InputError with
/// the faulty line and the reason.
PcdHeader parse_pcd_header(std::string_view bytes, const std::string& file);

/// The name of the channel in each field, see `channel_names`; empty for a field without numbers.
std::vector<std::string> pcd_channel_names(const PcdHeader& header);

/// The 8 bytes before a binary_compressed body, little-endian.
struct PcdCompressedSizes {
  std::uint64_t compressed = 0;    ///< Bytes that follow.
  std::uint64_t uncompressed = 0;  ///< Bytes after decompression.
};
constexpr std::size_t kPcdSizesBytes = 8;

/// The sizes at the start of `body`, which must have kPcdSizesBytes.
PcdCompressedSizes pcd_compressed_sizes(std::string_view body);

/// Throws InputError if a file of `file_bytes` bytes cannot contain the points that its header
/// declares. `head` is the file's start: the header and, for binary_compressed, at least the 8
/// bytes after it.
void check_pcd_size(const PcdHeader& header, std::string_view head, std::uint64_t file_bytes,
                    const std::string& file);

}  // namespace croon

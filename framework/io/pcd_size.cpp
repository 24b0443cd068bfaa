#include <string>

#include "framework/base/error.hpp"
#include "framework/io/pcd_header.hpp"

namespace croon {
namespace {

[[noreturn]] void fail(const std::string& file, const std::string& message) {
  throw InputError(file, "", message);
}

std::string promised(const PcdHeader& header) {
  return "expected " + std::to_string(header.points) + " points";
}

std::string bytes_found(std::uint64_t bytes) {
  return ", found " + std::to_string(bytes) + " bytes after the header";
}

void check_compressed(const PcdHeader& header, std::string_view head, std::uint64_t body_bytes,
                      const std::string& file) {
  if (body_bytes < kPcdSizesBytes) {
    fail(file, promised(header) + ", compressed" + bytes_found(body_bytes));
  }
  const PcdCompressedSizes sizes = pcd_compressed_sizes(head.substr(header.body_offset));
  if (sizes.compressed > body_bytes - kPcdSizesBytes) {
    fail(file, "expected " + std::to_string(sizes.compressed) + " compressed bytes, found " +
                   std::to_string(body_bytes - kPcdSizesBytes));
  }
  // LZF encodes at most 264 bytes in 3: a higher ratio is invalid and must not cause a large
  // allocation.
  constexpr std::uint64_t kMaxRatio = 88;
  if (sizes.uncompressed > kMaxRatio * sizes.compressed) {
    fail(file, std::to_string(sizes.compressed) + " compressed bytes cannot contain " +
                   std::to_string(sizes.uncompressed));
  }
  // Divides instead of multiplying to prevent overflow.
  if (sizes.uncompressed / header.point_bytes != header.points ||
      sizes.uncompressed % header.point_bytes != 0) {
    fail(file, promised(header) + " of " + std::to_string(header.point_bytes) + " bytes, found " +
                   std::to_string(sizes.uncompressed) + " uncompressed bytes");
  }
}

std::uint64_t four_bytes(std::string_view bytes) {
  const ScalarType type{ScalarKind::unsigned_integer, 4};
  return static_cast<std::uint64_t>(decode_scalar(type, ByteOrder::little, bytes.data()));
}

}  // namespace

PcdCompressedSizes pcd_compressed_sizes(std::string_view body) {
  return {four_bytes(body), four_bytes(body.substr(4))};
}

void check_pcd_size(const PcdHeader& header, std::string_view head, std::uint64_t file_bytes,
                    const std::string& file) {
  if (header.points == 0) return;
  const std::uint64_t body_bytes = file_bytes - header.body_offset;
  switch (header.encoding) {
    case PcdEncoding::ascii:
      // A number takes at least a digit and a separator, except at the end of the file.
      if (header.points > (body_bytes + 1) / (2 * header.point_words)) {
        fail(file, promised(header) + " of " + std::to_string(header.point_words) + " numbers" +
                       bytes_found(body_bytes));
      }
      break;
    case PcdEncoding::binary:
      if (header.points > body_bytes / header.point_bytes) {
        fail(file, promised(header) + " of " + std::to_string(header.point_bytes) + " bytes" +
                       bytes_found(body_bytes));
      }
      break;
    case PcdEncoding::binary_compressed:
      check_compressed(header, head, body_bytes, file);
      break;
  }
}

}  // namespace croon

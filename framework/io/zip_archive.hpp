#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace croon {

/// A file in a ZIP archive.
struct ZipEntry {
  std::string name;
  std::uint64_t compressed = 0;  ///< Bytes in the archive.
  std::uint64_t size = 0;        ///< Bytes of the file.
  std::uint64_t offset = 0;      ///< Offset of its local header in the archive.
  std::uint32_t crc = 0;
  bool is_deflated = false;  ///< Otherwise stored without compression.
};

/// The files in `bytes`, a ZIP archive (stored or deflated, not encrypted, in one part; ZIP64 for
/// file sizes). `file` is the name in errors. Throws InputError if it is not a ZIP archive or
/// damaged.
std::vector<ZipEntry> zip_entries(std::string_view bytes, const std::string& file);

/// The content of `entry`. Throws InputError if it is damaged.
std::string zip_content(std::string_view bytes, const ZipEntry& entry, const std::string& file);

}  // namespace croon

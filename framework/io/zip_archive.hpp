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
  std::uint64_t offset = 0;      ///< Of its local header in the archive.
  std::uint32_t crc = 0;
  bool is_deflated = false;  ///< Else it is stored.
};

/// The files in `bytes`, a ZIP archive (stored or deflated, not encrypted, in one part; ZIP64 for
/// the sizes of files). `file` is the name in errors. Throws InputError if it is another file or
/// damaged.
std::vector<ZipEntry> zip_entries(std::string_view bytes, const std::string& file);

/// The content of `entry`. Throws InputError if it is damaged.
std::string zip_content(std::string_view bytes, const ZipEntry& entry, const std::string& file);

}  // namespace croon

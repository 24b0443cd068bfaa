#include "framework/io/zip_archive.hpp"

#include <zlib.h>

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// Sizes of the fixed parts of the records, APPNOTE 4.3.
constexpr std::size_t kLocalBytes = 30, kCentralBytes = 46, kEndBytes = 22;
constexpr std::uint64_t kIsInZip64 = 0xFFFFFFFF;

[[noreturn]] void fail(const std::string& file, const std::string& message) {
  throw InputError(file, "", message);
}

/// The little-endian integer of `size` bytes at `at`, which must be inside `bytes`.
std::uint64_t number(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  }
  return value;
}

bool begins_with(std::string_view bytes, std::uint64_t at, std::string_view start) {
  return at <= bytes.size() && bytes.substr(at, start.size()) == start;
}

/// The offset of the end record of the archive, which a comment may follow.
std::size_t end_record(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kMaxComment = 0xFFFF;
  const std::size_t first =
      bytes.size() > kEndBytes + kMaxComment ? bytes.size() - kEndBytes - kMaxComment : 0;
  const std::size_t found = bytes.rfind("PK\x05\x06");
  if (found == std::string_view::npos || found < first || bytes.size() - found < kEndBytes) {
    fail(file, "is a damaged ZIP archive: its end is missing");
  }
  return found;
}

/// Replaces sizes and the offset that do not fit in 32 bits by those in the ZIP64 field of `extra`.
void read_zip64(std::string_view extra, ZipEntry& entry) {
  while (extra.size() >= 4) {
    const std::uint64_t id = number(extra, 0, 2);
    const std::size_t size =
        std::min<std::size_t>(static_cast<std::size_t>(number(extra, 2, 2)), extra.size() - 4);
    if (id == 1) {
      std::size_t at = 4;
      for (std::uint64_t* value : {&entry.size, &entry.compressed, &entry.offset}) {
        if (*value != kIsInZip64 || at + 8 > 4 + size) continue;
        *value = number(extra, at, 8);
        at += 8;
      }
    }
    extra.remove_prefix(4 + size);
  }
}

}  // namespace

std::vector<ZipEntry> zip_entries(std::string_view bytes, const std::string& file) {
  const std::size_t end = end_record(bytes, file);
  const std::uint64_t count = number(bytes, end + 10, 2);
  std::uint64_t at = number(bytes, end + 16, 4);
  std::vector<ZipEntry> entries;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (!begins_with(bytes, at, "PK\x01\x02") || bytes.size() - at < kCentralBytes) {
      fail(file, "is a damaged ZIP archive: its directory is cut off");
    }
    const std::string_view record = bytes.substr(at);
    const std::uint64_t method = number(record, 10, 2);
    const auto name_bytes = static_cast<std::size_t>(number(record, 28, 2));
    const auto extra_bytes = static_cast<std::size_t>(number(record, 30, 2));
    const auto comment_bytes = static_cast<std::size_t>(number(record, 32, 2));
    const std::size_t record_bytes = kCentralBytes + name_bytes + extra_bytes + comment_bytes;
    if (record_bytes > record.size()) {
      fail(file, "is a damaged ZIP archive: its directory is cut off");
    }
    ZipEntry entry;
    entry.name = record.substr(kCentralBytes, name_bytes);
    entry.crc = static_cast<std::uint32_t>(number(record, 16, 4));
    entry.compressed = number(record, 20, 4);
    entry.size = number(record, 24, 4);
    entry.offset = number(record, 42, 4);
    entry.is_deflated = method == 8;
    read_zip64(record.substr(kCentralBytes + name_bytes, extra_bytes), entry);
    const bool is_encrypted = (number(record, 8, 2) & 1U) != 0;
    if (is_encrypted || (method != 0 && method != 8)) {
      fail(file,
           "the entry " + in_quotes(entry.name) +
               " of the ZIP archive is encrypted or compressed with a method other than deflate");
    }
    entries.push_back(entry);
    at += record_bytes;
  }
  return entries;
}

std::string zip_content(std::string_view bytes, const ZipEntry& entry, const std::string& file) {
  const std::string damaged =
      "the entry " + in_quotes(entry.name) + " of the ZIP archive is damaged";
  if (!begins_with(bytes, entry.offset, "PK\x03\x04") ||
      bytes.size() - entry.offset < kLocalBytes) {
    fail(file, damaged);
  }
  const std::string_view local = bytes.substr(entry.offset);
  const auto start =
      static_cast<std::size_t>(kLocalBytes + number(local, 26, 2) + number(local, 28, 2));
  if (start > local.size() || entry.compressed > local.size() - start) fail(file, damaged);
  const std::string_view packed = local.substr(start, entry.compressed);
  // Deflate's maximum ratio: a higher one is invalid and must not cause a large allocation.
  constexpr std::uint64_t kMaxRatio = 1032;
  const bool is_possible = entry.is_deflated
                               ? entry.size / kMaxRatio <= entry.compressed &&
                                     entry.size < kIsInZip64 && entry.compressed < kIsInZip64
                               : entry.size == entry.compressed;
  if (!is_possible) fail(file, damaged);
  std::string content(static_cast<std::size_t>(entry.size), '\0');
  if (!entry.is_deflated) {
    content = packed;
  } else {
    z_stream stream{};
    constexpr int kRawDeflate = -15;
    if (inflateInit2(&stream, kRawDeflate) != Z_OK) fail(file, damaged);
    // zlib does not write to its input.
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(content.data());
    stream.avail_out = static_cast<uInt>(content.size());
    const int result = inflate(&stream, Z_FINISH);
    const bool is_whole = result == Z_STREAM_END && stream.total_out == content.size();
    inflateEnd(&stream);
    if (!is_whole) fail(file, damaged);
  }
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size());
  if (crc != entry.crc) fail(file, damaged);
  return content;
}

}  // namespace croon

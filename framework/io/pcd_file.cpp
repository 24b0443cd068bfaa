#include "framework/io/pcd_file.hpp"

#include <liblzf/lzf.h>
#include <cstring>
#include <optional>
#include <string>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/pcd_header.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// The bytes of all values of a coordinate: the first, and how far it is to the next.
struct Column {
  ScalarType type;
  const char* first;
  std::size_t stride;

  double at(std::size_t i) const {
    return decode_scalar(type, ByteOrder::little, first + i * stride);
  }
};

LoadedCloud from_columns(const std::array<Column, 3>& xyz, std::size_t points) {
  LoadedCloud cloud;
  cloud.points.reserve(points);
  for (std::size_t i = 0; i < points; ++i) cloud.add({xyz[0].at(i), xyz[1].at(i), xyz[2].at(i)});
  return cloud;
}

/// Point after point, and in each point field after field.
LoadedCloud from_binary(const PcdHeader& header, std::string_view body) {
  std::array<Column, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PcdField& field = header.fields[header.xyz[axis]];
    columns[axis] = {field.type, body.data() + field.first_byte, header.point_bytes};
  }
  return from_columns(columns, header.points);
}

/// Field after field, and in each field point after point; all of it compressed by LZF.
LoadedCloud from_compressed(const PcdHeader& header, std::string_view body,
                            const std::string& file) {
  const PcdCompressedSizes sizes = pcd_compressed_sizes(body);
  std::string raw(sizes.uncompressed, '\0');
  const unsigned int found =
      lzf_decompress(body.data() + kPcdSizesBytes, static_cast<unsigned int>(sizes.compressed),
                     raw.data(), static_cast<unsigned int>(raw.size()));
  if (found != raw.size()) throw InputError(file, "", "the compressed points are damaged");
  std::array<Column, 3> columns{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PcdField& field = header.fields[header.xyz[axis]];
    columns[axis] = {field.type, raw.data() + header.points * field.first_byte, field.type.size};
  }
  return from_columns(columns, header.points);
}

/// The coordinates in a line of a text body.
Eigen::Vector3d point_of_line(const PcdHeader& header, const LineReader& reader,
                              const std::string& file) {
  const std::vector<std::string_view> words = words_of(reader.line());
  if (words.size() != header.point_words) {
    throw InputError(file, reader.place(),
                     "expected " + std::to_string(header.point_words) + " numbers, found " +
                         std::to_string(words.size()));
  }
  Eigen::Vector3d point;
  for (int axis = 0; axis < 3; ++axis) {
    const PcdField& field = header.fields[header.xyz[static_cast<std::size_t>(axis)]];
    const std::string_view word = words[field.first_word];
    const std::optional<double> value = number_from(word);
    if (!value) {
      throw InputError(file, reader.place(),
                       "expected a number for " + field.name + ", found " + in_quotes(word));
    }
    point(axis) = *value;
  }
  return point;
}

LoadedCloud from_ascii(const PcdHeader& header, std::string_view body, const std::string& file) {
  LoadedCloud cloud;
  cloud.points.reserve(header.points);
  LineReader reader(body, header.lines);
  std::uint64_t points = 0;
  while (reader.next()) {
    if (trimmed(reader.line()).empty()) continue;
    if (++points > header.points) {
      throw InputError(file, reader.place(),
                       "expected " + std::to_string(header.points) + " points, found more");
    }
    cloud.add(point_of_line(header, reader, file));
  }
  if (points < header.points) {
    throw InputError(
        file, "",
        "expected " + std::to_string(header.points) + " points, found " + std::to_string(points));
  }
  return cloud;
}

std::string written_header(std::size_t points) {
  const std::string count = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\n"
         "VERSION 0.7\n"
         "FIELDS x y z intensity ring timestamp\n"
         "SIZE 4 4 4 4 2 8\n"
         "TYPE F F F F U F\n"
         "COUNT 1 1 1 1 1 1\n"
         "WIDTH " +
         count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
}

/// Appends the bytes of `value`; PCD's numbers are those of the machine, which is little-endian.
template <class Number>
void append(std::string& bytes, const Number& value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

}  // namespace

LoadedCloud parse_pcd(std::string_view bytes, const std::string& file) {
  const PcdHeader header = parse_pcd_header(bytes, file);
  check_pcd_size(header, bytes, bytes.size(), file);
  const std::string_view body = bytes.substr(header.body_offset);
  if (header.encoding == PcdEncoding::ascii) return from_ascii(header, body, file);
  if (header.points == 0) return {};
  return header.encoding == PcdEncoding::binary ? from_binary(header, body)
                                                : from_compressed(header, body, file);
}

void write_pcd(const std::filesystem::path& path, const MeasuredCloud& cloud) {
  std::string bytes = written_header(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, cloud.points[i](axis));
    append(bytes, cloud.intensity[i]);
    append(bytes, cloud.ring[i]);
    append(bytes, cloud.time_s[i]);
  }
  write_whole_file(path, bytes);
}

}  // namespace croon

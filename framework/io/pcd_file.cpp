#include "framework/io/pcd_file.hpp"

#include <liblzf/lzf.h>
#include <optional>
#include <string>

#include "framework/base/error.hpp"
#include "framework/io/cloud_columns.hpp"
#include "framework/io/pcd_header.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// A field that becomes a channel, and the channel read so far.
struct FieldChannel {
  const PcdField* field;
  Channel channel;
};

/// Empty channels for the fields other than x, y and z.
std::vector<FieldChannel> empty_channels(const PcdHeader& header) {
  const std::vector<std::string> names = pcd_channel_names(header);
  std::vector<FieldChannel> channels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const PcdField& field = header.fields[i];
    if (names[i].empty()) continue;
    channels.push_back({&field, {names[i], field.type, field.count, {}}});
  }
  return channels;
}

LoadedCloud empty_cloud(const PcdHeader& header, const Eigen::Vector3d& origin_m) {
  LoadedCloud cloud;
  cloud.origin_m = origin_m;
  if (!header.viewpoint.empty()) {
    cloud.notes.push_back("The viewpoint " + in_quotes(header.viewpoint) +
                          " is not applied: the points are used as they are stored.");
  }
  return cloud;
}

/// Reads the points of a binary body; `first` returns the first number of a field, `stride` its
/// distance to the next point's.
template <class First, class Stride>
LoadedCloud from_fields(const PcdHeader& header, LoadedCloud cloud, const First& first,
                        const Stride& stride) {
  const auto column = [&](const PcdField& field, const std::string& name) {
    return CloudColumn{name, field.type, field.count, first(field), stride(field)};
  };
  std::array<CloudColumn, 3> xyz;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    xyz[axis] = column(header.fields[header.xyz[axis]], "");
  }
  const std::vector<std::string> names = pcd_channel_names(header);
  std::vector<CloudColumn> channels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) channels.push_back(column(header.fields[i], names[i]));
  }
  return from_columns(std::move(cloud), header.points, xyz, channels);
}

/// Reads a body stored point by point, each with all fields.
LoadedCloud from_binary(const PcdHeader& header, LoadedCloud cloud, std::string_view body) {
  return from_fields(
      header, std::move(cloud),
      [&](const PcdField& field) { return body.data() + field.first_byte; },
      [&](const PcdField&) { return header.point_bytes; });
}

/// Reads an LZF-compressed body stored field by field, each with all points.
LoadedCloud from_compressed(const PcdHeader& header, LoadedCloud cloud, std::string_view body,
                            const std::string& file) {
  const PcdCompressedSizes sizes = pcd_compressed_sizes(body);
  std::string raw(sizes.uncompressed, '\0');
  const unsigned int found =
      lzf_decompress(body.data() + kPcdSizesBytes, static_cast<unsigned int>(sizes.compressed),
                     raw.data(), static_cast<unsigned int>(raw.size()));
  if (found != raw.size()) throw InputError(file, "", "the compressed points are damaged");
  return from_fields(
      header, std::move(cloud),
      [&](const PcdField& field) { return raw.data() + header.points * field.first_byte; },
      [](const PcdField& field) { return field.count * field.type.size; });
}

/// Reads the points of a text body.
class PointLines {
 public:
  PointLines(const PcdHeader& header, std::string_view body, const std::string& file)
      : header_(header), reader_(body, header.lines), file_(file) {}

  /// Advances to the next non-empty line; returns false at the end.
  bool next() {
    do {
      if (!reader_.next()) return false;
      split_words(reader_.line(), words_);
    } while (words_.empty());
    if (words_.size() == header_.point_words) return true;
    fail("expected " + std::to_string(header_.point_words) + " numbers, found " +
         std::to_string(words_.size()));
  }

  double coordinate(std::size_t axis) const {
    const PcdField& field = header_.fields[header_.xyz[axis]];
    const std::string_view word = words_[field.first_word];
    const std::optional<double> value = number_from(word);
    if (!value) fail("expected a number for " + field.name + ", found " + in_quotes(word));
    return *value;
  }

  /// Appends the numbers of `field` in this line to `bytes`.
  void append(std::string& bytes, const PcdField& field) const {
    for (std::uint64_t i = 0; i < field.count; ++i) {
      const std::string_view word = words_[field.first_word + i];
      if (append_scalar(bytes, field.type, word)) continue;
      fail("expected a number of its type for " + in_quotes(field.name) + ", found " +
           in_quotes(word));
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_, reader_.place(), message);
  }

 private:
  const PcdHeader& header_;
  LineReader reader_;
  const std::string& file_;
  std::vector<std::string_view> words_;
};

LoadedCloud from_ascii(const PcdHeader& header, LoadedCloud cloud, std::string_view body,
                       const std::string& file) {
  std::vector<FieldChannel> channels = empty_channels(header);
  cloud.points.reserve(header.points);
  for (FieldChannel& of : channels) {
    of.channel.bytes.reserve(header.points * of.channel.bytes_per_point());
  }
  const std::string expected = "expected " + std::to_string(header.points) + " points, found ";
  PointLines lines(header, body, file);
  std::uint64_t points = 0;
  while (lines.next()) {
    if (++points > header.points) lines.fail(expected + "more");
    if (!cloud.add({lines.coordinate(0), lines.coordinate(1), lines.coordinate(2)})) continue;
    for (FieldChannel& of : channels) lines.append(of.channel.bytes, *of.field);
  }
  if (points < header.points) throw InputError(file, "", expected + std::to_string(points));
  for (FieldChannel& of : channels) cloud.channels.push_back(std::move(of.channel));
  return cloud;
}

}  // namespace

LoadedCloud parse_pcd(std::string_view bytes, const std::string& file,
                      const Eigen::Vector3d& origin_m) {
  const PcdHeader header = parse_pcd_header(bytes, file);
  check_pcd_size(header, bytes, bytes.size(), file);
  const std::string_view body = bytes.substr(header.body_offset);
  LoadedCloud cloud = empty_cloud(header, origin_m);
  if (header.encoding == PcdEncoding::ascii) {
    return from_ascii(header, std::move(cloud), body, file);
  }
  // Without points, a compressed body may be missing.
  if (header.encoding == PcdEncoding::binary || header.points == 0) {
    return from_binary(header, std::move(cloud), body);
  }
  return from_compressed(header, std::move(cloud), body, file);
}

}  // namespace croon

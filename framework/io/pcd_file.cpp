#include "framework/io/pcd_file.hpp"

#include <liblzf/lzf.h>
#include <functional>
#include <optional>
#include <string>

#include "framework/base/error.hpp"
#include "framework/io/pcd_header.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// The bytes of all values of a field: those of the first point, and how far it is to the next.
struct Column {
  const char* first = nullptr;
  std::size_t stride = 0;

  const char* at(std::size_t i) const { return first + i * stride; }
};

/// A field that becomes a channel, and the channel so far.
struct FieldChannel {
  const PcdField* field;
  Channel channel;
};

/// The channels of the fields other than x, y and z, still empty.
std::vector<FieldChannel> empty_channels(const PcdHeader& header) {
  const std::vector<std::string> names = pcd_channel_names(header);
  std::vector<FieldChannel> channels;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const PcdField& field = header.fields[i];
    if (names[i].empty()) continue;
    channels.push_back({&field, {names[i], field.type, field.count, {}}});
    channels.back().channel.bytes.reserve(header.points * field.count * field.type.size);
  }
  return channels;
}

LoadedCloud with_channels(LoadedCloud cloud, std::vector<FieldChannel> channels) {
  for (FieldChannel& of : channels) cloud.channels.push_back(std::move(of.channel));
  return cloud;
}

/// The points of a binary body; `column` returns that of a field.
LoadedCloud from_columns(const PcdHeader& header,
                         const std::function<Column(const PcdField&)>& column) {
  LoadedCloud cloud;
  cloud.points.reserve(header.points);
  std::vector<FieldChannel> channels = empty_channels(header);
  std::array<Column, 3> xyz{};
  for (std::size_t axis = 0; axis < 3; ++axis) xyz[axis] = column(header.fields[header.xyz[axis]]);
  std::vector<Column> columns;
  for (const FieldChannel& of : channels) columns.push_back(column(*of.field));
  const auto coordinate = [&](std::size_t axis, std::size_t i) {
    const ScalarType type = header.fields[header.xyz[axis]].type;
    return decode_scalar(type, ByteOrder::little, xyz[axis].at(i));
  };
  for (std::size_t i = 0; i < header.points; ++i) {
    if (!cloud.add({coordinate(0, i), coordinate(1, i), coordinate(2, i)})) continue;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      Channel& channel = channels[c].channel;
      channel.bytes.append(columns[c].at(i), channel.bytes_per_point());
    }
  }
  return with_channels(std::move(cloud), std::move(channels));
}

/// Point after point, and in each point field after field.
LoadedCloud from_binary(const PcdHeader& header, std::string_view body) {
  return from_columns(header, [&](const PcdField& field) {
    return Column{body.data() + field.first_byte, header.point_bytes};
  });
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
  return from_columns(header, [&](const PcdField& field) {
    return Column{raw.data() + header.points * field.first_byte, field.count * field.type.size};
  });
}

/// The words of the points of a text body.
class PointLines {
 public:
  PointLines(const PcdHeader& header, std::string_view body, const std::string& file)
      : header_(header), reader_(body, header.lines), file_(file) {}

  /// Goes to the next line that is not empty; false at the end.
  bool next() {
    do {
      if (!reader_.next()) return false;
    } while (trimmed(reader_.line()).empty());
    words_ = words_of(reader_.line());
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

LoadedCloud from_ascii(const PcdHeader& header, std::string_view body, const std::string& file) {
  LoadedCloud cloud;
  cloud.points.reserve(header.points);
  std::vector<FieldChannel> channels = empty_channels(header);
  const std::string expected = "expected " + std::to_string(header.points) + " points, found ";
  PointLines lines(header, body, file);
  std::uint64_t points = 0;
  while (lines.next()) {
    if (++points > header.points) lines.fail(expected + "more");
    if (!cloud.add({lines.coordinate(0), lines.coordinate(1), lines.coordinate(2)})) continue;
    for (FieldChannel& of : channels) lines.append(of.channel.bytes, *of.field);
  }
  if (points < header.points) throw InputError(file, "", expected + std::to_string(points));
  return with_channels(std::move(cloud), std::move(channels));
}

}  // namespace

LoadedCloud parse_pcd(std::string_view bytes, const std::string& file) {
  const PcdHeader header = parse_pcd_header(bytes, file);
  check_pcd_size(header, bytes, bytes.size(), file);
  const std::string_view body = bytes.substr(header.body_offset);
  if (header.encoding == PcdEncoding::ascii) return from_ascii(header, body, file);
  if (header.points == 0) return with_channels({}, empty_channels(header));
  return header.encoding == PcdEncoding::binary ? from_binary(header, body)
                                                : from_compressed(header, body, file);
}

}  // namespace croon

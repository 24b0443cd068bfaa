#include <liblzf/lzf.h>

#include <cstdint>
#include <limits>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/channel_names.hpp"
#include "framework/io/pcd_file.hpp"

namespace croon {
namespace {

/// One line of the header: `word` and one value per field.
template <class Value>
std::string header_line(const char* word, const std::vector<Channel>& fields, const Value& value) {
  std::string line = word;
  for (const Channel& field : fields) line += " " + value(field);
  return line + "\n";
}

std::string type_letter(const Channel& channel) {
  if (channel.type.kind == ScalarKind::floating) return "F";
  return channel.type.kind == ScalarKind::signed_integer ? "I" : "U";
}

std::string header_of(const PointCloud& cloud, const std::vector<Channel>& fields,
                      const char* data) {
  const std::string count = std::to_string(cloud.size());
  const auto name = [&](const Channel& field) { return field_name(field.name, cloud); };
  const auto size = [](const Channel& field) { return std::to_string(field.type.size); };
  const auto numbers = [](const Channel& field) { return std::to_string(field.count); };
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" +
         header_line("FIELDS", fields, name) + header_line("SIZE", fields, size) +
         header_line("TYPE", fields, type_letter) + header_line("COUNT", fields, numbers) +
         "WIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA " +
         data + "\n";
}

/// The coordinates as channels, then the channels of the cloud.
std::vector<Channel> all_channels(const PointCloud& cloud) {
  std::vector<Channel> channels;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    for (const Eigen::Vector3f& point : cloud.points) values.push_back(point(axis));
    channels.push_back(make_channel(std::string(1, "xyz"[axis]), values));
  }
  channels.insert(channels.end(), cloud.channels.begin(), cloud.channels.end());
  return channels;
}

std::string binary_body(const std::vector<Channel>& channels, std::size_t points) {
  std::string body;
  for (std::size_t i = 0; i < points; ++i) {
    for (const Channel& channel : channels) {
      body.append(channel.bytes, i * channel.bytes_per_point(), channel.bytes_per_point());
    }
  }
  return body;
}

std::string text_body(const std::vector<Channel>& channels, std::size_t points) {
  std::string body;
  for (std::size_t i = 0; i < points; ++i) {
    std::string line;
    for (const Channel& channel : channels) {
      const char* at = channel.bytes.data() + i * channel.bytes_per_point();
      for (std::size_t k = 0; k < channel.count; ++k, at += channel.type.size) {
        line += (line.empty() ? "" : " ") + scalar_text(channel.type, at);
      }
    }
    body += line + "\n";
  }
  return body;
}

std::string compressed_body(const std::vector<Channel>& channels, const std::string& file) {
  std::string raw;
  for (const Channel& channel : channels) raw += channel.bytes;
  if (raw.size() > std::numeric_limits<std::uint32_t>::max() / 2) {
    throw InputError(file, "", "expected at most 2 GiB of points to compress, found more");
  }
  // Incompressible data grows by up to one byte per 32 (liblzf's literal runs).
  std::string packed(raw.size() + raw.size() / 16 + 64, '\0');
  const unsigned int size =
      raw.empty() ? 0
                  : lzf_compress(raw.data(), static_cast<unsigned int>(raw.size()), packed.data(),
                                 static_cast<unsigned int>(packed.size()));
  std::string body;
  for (const std::size_t bytes : {std::size_t{size}, raw.size()}) {
    append_scalar(body, scalar_type_of<std::uint32_t>(), static_cast<double>(bytes));
  }
  return body + packed.substr(0, size);
}

}  // namespace

void write_pcd(const std::filesystem::path& path, const PointCloud& cloud, PcdEncoding encoding) {
  check_writable(cloud, path);
  const std::vector<Channel> channels = all_channels(cloud);
  std::string bytes;
  switch (encoding) {
    case PcdEncoding::ascii:
      bytes = header_of(cloud, channels, "ascii") + text_body(channels, cloud.size());
      break;
    case PcdEncoding::binary:
      bytes = header_of(cloud, channels, "binary") + binary_body(channels, cloud.size());
      break;
    case PcdEncoding::binary_compressed:
      bytes = header_of(cloud, channels, "binary_compressed") +
              compressed_body(channels, path.string());
      break;
  }
  write_whole_file(path, bytes);
}

}  // namespace croon

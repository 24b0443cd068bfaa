#include "framework/io/ply_file.hpp"

#include <cstring>

#include "framework/base/error.hpp"
#include "framework/base/whole_file.hpp"
#include "framework/io/channel_names.hpp"
#include "framework/io/ply_header.hpp"
#include "framework/io/text_scan.hpp"
#include "framework/picture/colour.hpp"

namespace croon {
namespace {

void append_float(std::string& bytes, float value) {
  std::uint32_t bits = 0;
  static_assert(sizeof(bits) == sizeof(value), "PLY's float has 4 bytes");
  std::memcpy(&bits, &value, sizeof(bits));
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
}

void append_point(std::string& bytes, const Eigen::Vector3f& point) {
  for (int axis = 0; axis < 3; ++axis) append_float(bytes, point(axis));
}

/// Appends the point `index` of `cloud` with its channels.
void append_bytes(std::string& bytes, const PointCloud& cloud, std::size_t index) {
  append_point(bytes, cloud.points[index]);
  for (const Channel& channel : cloud.channels) {
    bytes.append(channel.bytes, index * channel.type.size, channel.type.size);
  }
}

/// The same as a line of text.
void append_text(std::string& text, const PointCloud& cloud, std::size_t index) {
  for (int axis = 0; axis < 3; ++axis) {
    const float* const value = cloud.points[index].data() + axis;
    text += (axis > 0 ? " " : "") +
            scalar_text(scalar_type_of<float>(), reinterpret_cast<const char*>(value));
  }
  for (const Channel& channel : cloud.channels) {
    text += ' ' + scalar_text(channel.type, channel.bytes.data() + index * channel.type.size);
  }
  text += '\n';
}

constexpr const char* kBinary = "binary_little_endian";

/// Marks the files of `write_fused_ply` for `is_fused_ply`.
const std::string kFusedComment = "comment croon: clouds of a rig, fused\n";

/// The lines before the comments.
std::string first_lines(const std::string& format) { return "ply\nformat " + format + " 1.0\n"; }

std::string header(const std::string& format, const std::string& comments, std::size_t vertices,
                   const std::string& colours) {
  return first_lines(format) + comments + "element vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\n" + colours + "end_header\n";
}

/// A sensor's name without line breaks.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  }
  return text;
}

}  // namespace

void write_ply(const std::filesystem::path& path, const PointCloud& cloud, PlyFormat format) {
  check_writable(cloud, path);
  const bool is_ascii = format == PlyFormat::ascii;
  std::string properties;
  for (const Channel& channel : cloud.channels) {
    const std::string type = ply_type_name(channel.type);
    if (type.empty() || channel.count != 1) {
      throw InputError(path.string(), "",
                       "expected channels of one number of at most 4 bytes, or a double, per "
                       "point, found another type in " +
                           in_quotes(channel.name) + "; PCD supports all types");
    }
    properties += "property " + type + " " + field_name(channel.name, cloud) + "\n";
  }
  std::string bytes = header(is_ascii ? "ascii" : kBinary, "", cloud.size(), properties);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    is_ascii ? append_text(bytes, cloud, i) : append_bytes(bytes, cloud, i);
  }
  write_whole_file(path, bytes);
}

void write_fused_ply(const std::filesystem::path& path, const std::vector<ColouredCloud>& clouds) {
  std::string comments = kFusedComment;
  std::string body;
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    const Colour colour = sensor_colour(i);
    comments += "comment " + one_line(clouds[i].sensor) + " is " + std::to_string(colour.red) +
                " " + std::to_string(colour.green) + " " + std::to_string(colour.blue) + "\n";
    vertices += clouds[i].points.size();
    for (const Eigen::Vector3f& point :
         transformed(clouds[i].points, clouds[i].T_reference_sensor)) {
      append_point(body, point);
      for (const std::uint8_t channel : {colour.red, colour.green, colour.blue}) {
        body += static_cast<char>(channel);
      }
    }
  }
  const char* const colours = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  write_whole_file(path, header(kBinary, comments, vertices, colours) + body);
}

bool is_fused_ply(const std::filesystem::path& path) {
  return file_begins_with(path, first_lines(kBinary) + kFusedComment);
}

}  // namespace croon

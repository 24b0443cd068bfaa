#include "framework/io/ply_file.hpp"

#include <array>
#include <charconv>
#include <cstring>

#include "framework/base/whole_file.hpp"
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

void append_text(std::string& bytes, const Eigen::Vector3f& point) {
  std::array<char, 32> text{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto end = std::to_chars(text.data(), text.data() + text.size(), point(axis)).ptr;
    bytes.append(text.data(), end);
    bytes += axis < 2 ? ' ' : '\n';
  }
}

std::string header(const std::string& format, const std::string& comments, std::size_t vertices,
                   const std::string& colours) {
  return "ply\nformat " + format + " 1.0\n" + comments + "element vertex " +
         std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\n" +
         colours + "end_header\n";
}

/// A sensor's name in one line, whatever its file was called.
std::string one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = '?';
  }
  return text;
}

}  // namespace

void write_ply(const std::filesystem::path& path, const PointCloud& cloud, PlyFormat format) {
  const bool is_ascii = format == PlyFormat::ascii;
  std::string bytes = header(is_ascii ? "ascii" : "binary_little_endian", "", cloud.size(), "");
  for (const Eigen::Vector3f& point : cloud) {
    if (is_ascii) {
      append_text(bytes, point);
    } else {
      append_point(bytes, point);
    }
  }
  write_whole_file(path, bytes);
}

void write_fused_ply(const std::filesystem::path& path, const std::vector<ColouredCloud>& clouds) {
  std::string comments, body;
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
  write_whole_file(path, header("binary_little_endian", comments, vertices, colours) + body);
}

}  // namespace croon

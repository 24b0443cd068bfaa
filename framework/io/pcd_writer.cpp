#include "framework/io/pcd_writer.hpp"

#include <cstring>
#include <string>

#include "framework/base/whole_file.hpp"

namespace croon {
namespace {

std::string header(std::size_t points) {
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

void write_pcd(const std::filesystem::path& path, const MeasuredCloud& cloud) {
  std::string bytes = header(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) append(bytes, cloud.points[i](axis));
    append(bytes, cloud.intensity[i]);
    append(bytes, cloud.ring[i]);
    append(bytes, cloud.time_s[i]);
  }
  write_whole_file(path, bytes);
}

}  // namespace croon

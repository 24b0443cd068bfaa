#include "test/framework/io/cloud_bytes.hpp"

#include <liblzf/lzf.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <sstream>

namespace croon::test {
namespace {

template <class T>
std::string bytes_as(double value) {
  const T typed = static_cast<T>(value);
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &typed, sizeof(T));
  return bytes;
}

std::string native_bytes(char type, std::size_t size, double value) {
  if (type == 'F') return size == 4 ? bytes_as<float>(value) : bytes_as<double>(value);
  const bool is_signed = type == 'I';
  switch (size) {
    case 1:
      return is_signed ? bytes_as<std::int8_t>(value) : bytes_as<std::uint8_t>(value);
    case 2:
      return is_signed ? bytes_as<std::int16_t>(value) : bytes_as<std::uint16_t>(value);
    case 4:
      return is_signed ? bytes_as<std::int32_t>(value) : bytes_as<std::uint32_t>(value);
    default:
      return is_signed ? bytes_as<std::int64_t>(value) : bytes_as<std::uint64_t>(value);
  }
}

double value_of(const FieldSpec& field, const Eigen::Vector3f& point) {
  const std::size_t axis = std::string("xyz").find(field.name);
  return axis < 3 ? static_cast<double>(point(static_cast<Eigen::Index>(axis))) : 7.0;
}

std::string field_bytes(const FieldSpec& field, const Eigen::Vector3f& point) {
  std::string bytes;
  for (std::size_t i = 0; i < field.count; ++i) {
    bytes += scalar_bytes(field.type, field.size, value_of(field, point), ByteOrder::little);
  }
  return bytes;
}

std::string ascii_body(const PcdSpec& spec, const Points& cloud) {
  std::ostringstream text;
  text.precision(9);
  for (const Eigen::Vector3f& point : cloud) {
    for (const FieldSpec& field : spec.fields) {
      for (std::size_t i = 0; i < field.count; ++i) text << value_of(field, point) << ' ';
    }
    text << spec.line_end;
  }
  return text.str();
}

std::string compressed_body(const PcdSpec& spec, const Points& cloud) {
  std::string raw;
  for (const FieldSpec& field : spec.fields) {
    for (const Eigen::Vector3f& point : cloud) raw += field_bytes(field, point);
  }
  std::string packed(2 * raw.size() + 64, '\0');
  const unsigned int size = lzf_compress(raw.data(), static_cast<unsigned int>(raw.size()),
                                         packed.data(), static_cast<unsigned int>(packed.size()));
  packed.resize(size);
  return scalar_bytes('U', 4, size, ByteOrder::little) +
         scalar_bytes('U', 4, static_cast<double>(raw.size()), ByteOrder::little) + packed;
}

}  // namespace

std::string scalar_bytes(char type, std::size_t size, double value, ByteOrder order) {
  std::string bytes = native_bytes(type, size, value);
  const std::uint16_t one = 1;
  const bool is_little = *reinterpret_cast<const unsigned char*>(&one) == 1;
  if (is_little != (order == ByteOrder::little)) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string pcd_header(const PcdSpec& spec, std::size_t points) {
  std::string fields, sizes, types, counts;
  for (const FieldSpec& field : spec.fields) {
    fields += " " + field.name;
    sizes += " " + std::to_string(field.size);
    types += std::string(" ") + field.type;
    counts += " " + std::to_string(field.count);
  }
  std::string text;
  const std::string count = std::to_string(points);
  for (const std::string& line :
       {std::string("# .PCD - a comment"), "VERSION " + spec.version, "FIELDS" + fields,
        "SIZE" + sizes, "TYPE" + types, "COUNT" + counts, "WIDTH " + count, std::string("HEIGHT 1"),
        std::string("VIEWPOINT 1 2 3 0 1 0 0"), "POINTS " + count, "DATA " + spec.data}) {
    text += line + spec.line_end;
  }
  return text;
}

std::string pcd_bytes(const PcdSpec& spec, const Points& cloud) {
  std::string body;
  if (spec.data == "ascii") {
    body = ascii_body(spec, cloud);
  } else if (spec.data == "binary_compressed") {
    body = compressed_body(spec, cloud);
  } else {
    for (const Eigen::Vector3f& point : cloud) {
      for (const FieldSpec& field : spec.fields) body += field_bytes(field, point);
    }
  }
  return pcd_header(spec, cloud.size()) + body;
}

}  // namespace croon::test

#include "framework/io/ply_file.hpp"

#include <optional>

#include "framework/base/error.hpp"
#include "framework/io/ply_header.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// Reads the elements of a binary body one after the other.
class BinaryBody {
 public:
  BinaryBody(const PlyHeader& header, std::string_view body, const std::string& file)
      : order_(header.encoding == PlyEncoding::binary_big_endian ? ByteOrder::big
                                                                 : ByteOrder::little),
        rest_(body),
        file_(file) {}

  /// Reads the next element's values, by property; lists are skipped, with their length as the
  /// value.
  void next(const PlyElement& element, std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      const ScalarType first = property.list_count.value_or(property.type);
      values[i] = decode_scalar(first, order_, take(first.size, element));
      if (!property.list_count) continue;
      if (values[i] < 0)
        throw InputError(file_, "",
                         "a list of " + in_quotes(element.name) + " has a negative length");
      take(static_cast<std::uint64_t>(values[i]) * property.type.size, element);
    }
  }

  /// Not reached: numbers are read in their own type.
  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, "", message); }

 private:
  const char* take(std::uint64_t bytes, const PlyElement& element) {
    if (bytes > rest_.size()) {
      throw InputError(file_, "", "ends inside the element " + in_quotes(element.name));
    }
    const char* const start = rest_.data();
    rest_.remove_prefix(bytes);
    return start;
  }

  ByteOrder order_;
  std::string_view rest_;
  const std::string& file_;
};

/// Reads the elements of a text body, one per non-empty line.
class TextBody {
 public:
  TextBody(const PlyHeader& header, std::string_view body, const std::string& file)
      : reader_(body, header.lines), file_(file) {}

  void next(const PlyElement& element, std::vector<double>& values) {
    do {
      if (!reader_.next()) {
        throw InputError(file_, "", "ends inside the element " + in_quotes(element.name));
      }
    } while (trimmed(reader_.line()).empty());
    std::string_view rest = reader_.line();
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = number(rest, element.properties[i]);
      if (element.properties[i].list_count) skip_list(rest, element.properties[i], values[i]);
    }
    if (!trimmed(rest).empty()) fail("expected the line to end, found " + in_quotes(trimmed(rest)));
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_, reader_.place(), message);
  }

 private:
  double number(std::string_view& rest, const PlyProperty& property) const {
    const std::string_view word = next_word(rest);
    const std::optional<double> value = number_from(word);
    if (!value) fail("expected a number for " + property.name + ", found " + in_quotes(word));
    return *value;
  }

  void skip_list(std::string_view& rest, const PlyProperty& property, double length) const {
    if (!(length >= 0)) fail("expected the length of the list " + property.name);
    // Stops at the end of the line, whatever length is declared.
    for (double i = 0; i < length; ++i) number(rest, property);
  }

  LineReader reader_;
  const std::string& file_;
};

template <class Body>
LoadedCloud read_vertices(const PlyHeader& header, Body body, const Eigen::Vector3d& origin_m) {
  std::vector<double> values;
  for (std::size_t e = 0; e < header.vertex; ++e) {
    const PlyElement& element = header.elements[e];
    values.resize(element.properties.size());
    // Elements without properties take no space, whatever their number.
    for (std::uint64_t i = 0; !values.empty() && i < element.count; ++i) body.next(element, values);
  }
  const PlyElement& vertex = header.elements[header.vertex];
  values.resize(vertex.properties.size());
  LoadedCloud cloud;
  cloud.origin_m = origin_m;
  cloud.points.reserve(vertex.count);
  const std::vector<std::string> names = ply_channel_names(header);
  std::vector<std::size_t> properties;
  for (std::size_t p = 0; p < names.size(); ++p) {
    if (names[p].empty()) continue;
    properties.push_back(p);
    cloud.channels.push_back({names[p], vertex.properties[p].type, 1, {}});
    cloud.channels.back().bytes.reserve(vertex.count * vertex.properties[p].type.size);
  }
  for (std::uint64_t i = 0; i < vertex.count; ++i) {
    body.next(vertex, values);
    if (!cloud.add({values[header.xyz[0]], values[header.xyz[1]], values[header.xyz[2]]})) continue;
    for (std::size_t c = 0; c < properties.size(); ++c) {
      const PlyProperty& property = vertex.properties[properties[c]];
      if (append_scalar(cloud.channels[c].bytes, property.type, values[properties[c]])) continue;
      body.fail("expected a number of its type for " + in_quotes(property.name));
    }
  }
  return cloud;
}

}  // namespace

LoadedCloud parse_ply(std::string_view bytes, const std::string& file,
                      const Eigen::Vector3d& origin_m) {
  const PlyHeader header = parse_ply_header(bytes, file);
  check_ply_size(header, bytes.size(), file);
  const std::string_view body = bytes.substr(header.body_offset);
  return header.encoding == PlyEncoding::ascii
             ? read_vertices(header, TextBody(header, body, file), origin_m)
             : read_vertices(header, BinaryBody(header, body, file), origin_m);
}

}  // namespace croon

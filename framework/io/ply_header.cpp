#include "framework/io/ply_header.hpp"

#include <algorithm>
#include <map>

#include "framework/base/error.hpp"
#include "framework/io/channel_names.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

const std::map<std::string, ScalarType, std::less<>>& scalar_types() {
  constexpr ScalarKind kFloating = ScalarKind::floating, kSigned = ScalarKind::signed_integer,
                       kUnsigned = ScalarKind::unsigned_integer;
  static const std::map<std::string, ScalarType, std::less<>> types = {
      {"char", {kSigned, 1}},     {"int8", {kSigned, 1}},     {"uchar", {kUnsigned, 1}},
      {"uint8", {kUnsigned, 1}},  {"short", {kSigned, 2}},    {"int16", {kSigned, 2}},
      {"ushort", {kUnsigned, 2}}, {"uint16", {kUnsigned, 2}}, {"int", {kSigned, 4}},
      {"int32", {kSigned, 4}},    {"uint", {kUnsigned, 4}},   {"uint32", {kUnsigned, 4}},
      {"bool", {kUnsigned, 1}},   {"float", {kFloating, 4}},  {"float32", {kFloating, 4}},
      {"double", {kFloating, 8}}, {"float64", {kFloating, 8}}};
  return types;
}

/// Parses the lines of the header.
class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& file)
      : file_(file), reader_(bytes.substr(0, kMaxHeaderBytes)) {}

  PlyHeader parse() {
    if (!reader_.next() || trimmed(reader_.line()) != "ply") {
      throw InputError(file_, "line 1",
                       "is not a PLY file: expected \"ply\", found " + in_quotes(reader_.line()));
    }
    for (bool has_format = false;;) {
      if (!reader_.next()) throw InputError(file_, "", "the header ends without end_header");
      const std::vector<std::string_view> words = words_of(reader_.line());
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
      if (words[0] == "end_header") break;
      if (!has_format) {
        read_format(words);
        has_format = true;
      } else {
        read_declaration(words);
      }
    }
    header_.body_offset = reader_.end();
    header_.lines = reader_.number();
    find_vertex();
    return header_;
  }

 private:
  [[noreturn]] void expected(const std::string& what) const {
    throw InputError(file_, reader_.place(),
                     "expected " + what + ", found " + in_quotes(reader_.line()));
  }

  void read_format(const std::vector<std::string_view>& words) {
    if (words.size() != 3 || words[0] != "format" || words[2] != "1.0") {
      expected("\"format ENCODING 1.0\"");
    }
    if (words[1] == "ascii") {
      header_.encoding = PlyEncoding::ascii;
    } else if (words[1] == "binary_little_endian") {
      header_.encoding = PlyEncoding::binary_little_endian;
    } else if (words[1] == "binary_big_endian") {
      header_.encoding = PlyEncoding::binary_big_endian;
    } else {
      expected("the format ascii, binary_little_endian or binary_big_endian");
    }
  }

  void read_declaration(const std::vector<std::string_view>& words) {
    if (words[0] == "element" && words.size() == 3) {
      const std::optional<std::uint64_t> count = count_from(words[2]);
      if (!count) expected("a number of elements");
      for (const PlyElement& element : header_.elements) {
        if (element.name == words[1]) expected("each element once");
      }
      header_.elements.push_back({std::string(words[1]), *count, {}});
    } else if (words[0] == "property" && words.size() == 3) {
      add_property({std::string(words[2]), type(words[1]), std::nullopt});
    } else if (words[0] == "property" && words.size() == 5 && words[1] == "list") {
      const ScalarType length = type(words[2]);
      if (length.kind == ScalarKind::floating) expected("a list whose length is a whole number");
      add_property({std::string(words[4]), type(words[3]), length});
    } else {
      expected("an element, a property, a comment or end_header");
    }
  }

  ScalarType type(std::string_view name) const {
    const auto found = scalar_types().find(name);
    if (found != scalar_types().end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [known_name, scalar] : scalar_types()) known.push_back(known_name);
    throw InputError(file_, reader_.place(),
                     "unknown type " + in_quotes(name) + name_hint(std::string(name), known));
  }

  void add_property(const PlyProperty& property) {
    if (header_.elements.empty()) expected("an element before its properties");
    std::vector<PlyProperty>& properties = header_.elements.back().properties;
    for (const PlyProperty& other : properties) {
      const bool is_same = other.name == property.name && !other.list_count && !property.list_count;
      const bool is_axis = property.name.size() == 1 &&
                           std::string_view("xyzXYZ").find(property.name) != std::string::npos;
      if (is_same && is_axis) expected("each coordinate once");
    }
    properties.push_back(property);
  }

  void find_vertex() {
    const auto is_vertex = [](const PlyElement& element) { return element.name == "vertex"; };
    const auto& elements = header_.elements;
    const auto vertex = std::find_if(elements.begin(), elements.end(), is_vertex);
    if (vertex == elements.end()) throw InputError(file_, "", "the element vertex is missing");
    header_.vertex = static_cast<std::size_t>(vertex - elements.begin());
    for (std::size_t axis = 0; axis < 3; ++axis) header_.xyz[axis] = find_axis(*vertex, axis);
  }

  /// The index of the property x, y or z, or otherwise X, Y or Z.
  std::size_t find_axis(const PlyElement& vertex, std::size_t axis) const {
    for (const char name : {"xyz"[axis], "XYZ"[axis]}) {
      for (std::size_t i = 0; i < vertex.properties.size(); ++i) {
        const PlyProperty& property = vertex.properties[i];
        if (property.name == std::string(1, name) && !property.list_count) return i;
      }
    }
    throw InputError(file_, "", std::string("the vertex property ") + "xyz"[axis] + " is missing");
  }

  const std::string& file_;
  LineReader reader_;
  PlyHeader header_;
};

/// The minimum size of one element: in text, a digit and a blank for each property; lists may be
/// empty.
std::uint64_t min_bytes(const PlyHeader& header, const PlyElement& element) {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : element.properties) {
    bytes += header.encoding == PlyEncoding::ascii
                 ? 2
                 : property.list_count.value_or(property.type).size;
  }
  return bytes;
}

}  // namespace

PlyHeader parse_ply_header(std::string_view bytes, const std::string& file) {
  return HeaderParser(bytes, file).parse();
}

std::vector<std::string> ply_channel_names(const PlyHeader& header) {
  std::vector<std::string> fields;
  for (const PlyProperty& property : header.elements[header.vertex].properties) {
    fields.push_back(property.list_count ? "_" : property.name);
  }
  for (const std::size_t axis : header.xyz) fields[axis] = "_";
  return channel_names(fields);
}

std::string ply_type_name(ScalarType type) {
  // Of the two names of each type, the original one.
  for (const char* name : {"char", "uchar", "short", "ushort", "int", "uint", "float", "double"}) {
    if (scalar_types().find(name)->second == type) return name;
  }
  return "";
}

void check_ply_size(const PlyHeader& header, std::uint64_t file_bytes, const std::string& file) {
  std::uint64_t left = file_bytes - header.body_offset;
  // The last line of text may lack its line ending.
  if (header.encoding == PlyEncoding::ascii) ++left;
  for (const PlyElement& element : header.elements) {
    const std::uint64_t each = min_bytes(header, element);
    if (each == 0) continue;
    if (element.count > left / each) {
      throw InputError(file, "",
                       "expected " + std::to_string(element.count) + " of the element " +
                           in_quotes(element.name) + " of at least " + std::to_string(each) +
                           " bytes, found the end of the file after " + std::to_string(left));
    }
    left -= element.count * each;
  }
}

}  // namespace croon

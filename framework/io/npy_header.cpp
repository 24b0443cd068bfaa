#include "framework/io/npy_header.hpp"

#include <limits>
#include <optional>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/io/channel_names.hpp"
#include "framework/io/float_rows.hpp"
#include "framework/io/python_literal.hpp"
#include "framework/io/text_scan.hpp"

namespace croon {
namespace {

/// The type of one number, of padding, or of a subarray.
struct Dtype {
  ScalarType type;
  ByteOrder order = ByteOrder::little;
};

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& file) : file_(file) {
    const std::string_view text = dictionary(bytes);
    try {
      dict_ = parse_python_literal(text);
    } catch (const std::invalid_argument&) {
      fail("expected the header of a NumPy array, found " + in_quotes(text));
    }
  }

  NpyHeader read() {
    const PythonLiteral& descr = at("descr");
    const PythonLiteral& order = at("fortran_order");
    if (order.kind != PythonLiteral::Kind::truth)
      fail("expected fortran_order to be True or False");
    std::vector<std::uint64_t> shape;
    if (at("shape").kind != PythonLiteral::Kind::list) fail("expected a shape");
    for (const PythonLiteral& length : at("shape").items) shape.push_back(number(length));
    if (descr.kind == PythonLiteral::Kind::list) {
      read_structured(descr, shape);
    } else {
      read_plain(dtype(descr), shape, order.is_true);
    }
    find_xyz();
    return header_;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, "", message); }

  std::string_view dictionary(std::string_view bytes) {
    constexpr std::string_view kMagic = "\x93NUMPY";
    constexpr std::size_t kPrefix = 8;  // The magic and two bytes of version.
    if (bytes.substr(0, kMagic.size()) != kMagic || bytes.size() < kPrefix + 4) {
      fail("is not a NumPy array: it does not begin with \"\\x93NUMPY\"");
    }
    const auto version = static_cast<unsigned char>(bytes[kMagic.size()]);
    if (version < 1 || version > 3) {
      fail("expected version 1, 2 or 3 of the format, found " + std::to_string(version));
    }
    const std::size_t size_bytes = version == 1 ? 2 : 4;
    const ScalarType type{ScalarKind::unsigned_integer, size_bytes};
    const auto size =
        static_cast<std::uint64_t>(decode_scalar(type, ByteOrder::little, bytes.data() + kPrefix));
    bytes = bytes.substr(0, kMaxHeaderBytes_);
    const std::size_t start = kPrefix + size_bytes;
    if (size > bytes.size() - start) fail("the header of the NumPy array is cut off");
    header_.body_offset = start + size;
    return bytes.substr(start, size);
  }

  const PythonLiteral& at(const char* key) const {
    const PythonLiteral* value = dict_.find(key);
    if (value == nullptr) fail(std::string("the header has no ") + key);
    return *value;
  }

  std::uint64_t number(const PythonLiteral& literal) const {
    const std::optional<std::uint64_t> value = count_from(literal.text);
    if (literal.kind != PythonLiteral::Kind::number || !value)
      fail("expected a whole number in the header");
    return *value;
  }

  /// Parses a type such as "<f4", or padding such as "|V4", whose type is then unused.
  Dtype dtype(const PythonLiteral& literal) const {
    const std::string& text = literal.text;
    if (literal.kind == PythonLiteral::Kind::text && text.size() == 3) {
      const char order = text[0], kind = text[1];
      const auto size = static_cast<std::size_t>(text[2] - '0');
      const bool is_order = order == '<' || order == '>' || order == '|' || order == '=';
      const bool is_size = size == 1 || size == 2 || size == 4 || size == 8;
      const ByteOrder bytes = order == '>' ? ByteOrder::big : ByteOrder::little;
      if (is_order && is_size) {
        if (kind == 'f' && size >= 4) return {{ScalarKind::floating, size}, bytes};
        if (kind == 'i') return {{ScalarKind::signed_integer, size}, bytes};
        if (kind == 'u') return {{ScalarKind::unsigned_integer, size}, bytes};
        if (kind == 'b' && size == 1) return {{ScalarKind::unsigned_integer, 1}, bytes};
      }
    }
    fail("expected numbers of 1 to 8 bytes, float32 or float64, found the type " +
         in_quotes(literal.kind == PythonLiteral::Kind::text ? text : "another") +
         "; save array.astype(numpy.float32)");
  }

  std::uint64_t product(std::uint64_t a, std::uint64_t b) const {
    constexpr std::uint64_t kMax = std::numeric_limits<std::int64_t>::max();
    if (b != 0 && a > kMax / b) fail("the shape of the array is implausibly large");
    return a * b;
  }

  std::uint64_t product(const std::vector<std::uint64_t>& lengths) const {
    std::uint64_t all = 1;
    for (const std::uint64_t length : lengths) all = product(all, length);
    return all;
  }

  void read_plain(Dtype type, const std::vector<std::uint64_t>& shape, bool is_fortran) {
    constexpr std::uint64_t kMinColumns = 3, kMaxColumns = 16;
    std::string found;
    for (const std::uint64_t length : shape) {
      found += (found.empty() ? "" : "×") + std::to_string(length);
    }
    const bool is_image = shape.size() == 3 && !is_fortran;
    if (shape.size() != 2 && !is_image) {
      fail("expected an array N×3, N×4 or with fields x, y, z, found the shape (" + found + ")");
    }
    const std::uint64_t columns = shape.back();
    if (columns < kMinColumns || columns > kMaxColumns) {
      const bool is_turned = shape.size() == 2 && shape[0] >= kMinColumns && shape[0] <= 8;
      fail("expected an array N×3, N×4 or with fields x, y, z, found the shape (" + found + ")" +
           (is_turned ? "; save array.T" : ""));
    }
    header_.points = product({shape.begin(), shape.end() - 1});
    header_.data_bytes = product(product(header_.points, columns), type.type.size);
    for (std::uint64_t c = 0; c < columns; ++c) {
      NpyField field;
      field.name = c < 3 ? std::string(1, "xyz"[c]) : name_of_column(c, columns);
      field.type = type.type;
      field.order = type.order;
      field.first_byte = c * type.type.size * (is_fortran ? header_.points : 1);
      field.stride = type.type.size * (is_fortran ? 1 : columns);
      header_.fields.push_back(field);
    }
  }

  void read_structured(const PythonLiteral& descr, const std::vector<std::uint64_t>& shape) {
    std::uint64_t bytes = 0;
    for (const PythonLiteral& entry : descr.items) bytes += read_field(entry, bytes);
    for (NpyField& field : header_.fields) field.stride = bytes;
    header_.points = product(shape);
    header_.data_bytes = product(header_.points, bytes);
  }

  /// Adds a field of a structured array that begins at byte `first`; returns its number of bytes.
  std::uint64_t read_field(const PythonLiteral& entry, std::uint64_t first) {
    constexpr std::uint64_t kMaxBytes = 1U << 20U;
    const std::vector<PythonLiteral>& parts = entry.items;
    if (entry.kind != PythonLiteral::Kind::list || parts.size() < 2 || parts.size() > 3) {
      fail("expected the name and type of each field");
    }
    // A field with a title has a pair of names.
    const PythonLiteral& name =
        parts[0].kind == PythonLiteral::Kind::list && !parts[0].items.empty()
            ? parts[0].items.back()
            : parts[0];
    if (name.kind != PythonLiteral::Kind::text) fail("expected the name of a field");
    if (parts[1].kind == PythonLiteral::Kind::text && parts[1].text.substr(0, 2) == "|V") {
      const std::optional<std::uint64_t> size = count_from(parts[1].text.substr(2));
      if (parts.size() == 2 && size && *size <= kMaxBytes) return *size;
      fail("expected the size of the padding, found " + in_quotes(parts[1].text));
    }
    const Dtype type = dtype(parts[1]);
    NpyField field{name.text, type.type, type.order, 1, first, 0};
    if (parts.size() == 3) {
      if (parts[2].kind != PythonLiteral::Kind::list) fail("expected the shape of a field");
      for (const PythonLiteral& length : parts[2].items) {
        field.count = product(field.count, number(length));
      }
    }
    const std::uint64_t bytes = product(field.count, type.type.size);
    if (bytes > kMaxBytes) fail("the field " + in_quotes(name.text) + " is implausibly large");
    header_.fields.push_back(field);
    return bytes;
  }

  void find_xyz() {
    for (std::size_t axis = 0; axis < 3; ++axis) header_.xyz[axis] = find_axis(axis);
  }

  std::size_t find_axis(std::size_t axis) const {
    for (const char name : {"xyz"[axis], "XYZ"[axis]}) {
      for (std::size_t i = 0; i < header_.fields.size(); ++i) {
        const NpyField& field = header_.fields[i];
        if (field.name == std::string(1, name) && field.count == 1) return i;
      }
    }
    std::vector<std::string> names;
    for (const NpyField& field : header_.fields) names.push_back(field.name);
    fail(std::string("the array has no field ") + "xyz"[axis] + name_hint("xyz", names));
  }

  static constexpr std::size_t kMaxHeaderBytes_ = kMaxHeaderBytes;
  const std::string& file_;
  PythonLiteral dict_;
  NpyHeader header_;
};

}  // namespace

NpyHeader parse_npy_header(std::string_view bytes, const std::string& file) {
  return HeaderReader(bytes, file).read();
}

std::vector<std::string> npy_channel_names(const NpyHeader& header) {
  std::vector<std::string> names;
  for (const NpyField& field : header.fields) {
    names.push_back(field.count > 0 && !field.name.empty() ? field.name : "_");
  }
  for (const std::size_t axis : header.xyz) names[axis] = "_";
  return channel_names(names);
}

void check_npy_size(const NpyHeader& header, std::uint64_t file_bytes, const std::string& file) {
  const std::uint64_t found = file_bytes - header.body_offset;
  if (found >= header.data_bytes) return;
  throw InputError(file, "",
                   "expected " + std::to_string(header.points) + " points of " +
                       std::to_string(header.data_bytes) + " bytes, found " +
                       std::to_string(found) + " bytes after the header");
}

}  // namespace croon

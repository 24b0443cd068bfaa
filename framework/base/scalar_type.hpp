#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace croon {

enum class ScalarKind { floating, signed_integer, unsigned_integer };
enum class ByteOrder { little, big };

/// The type of one number in a binary file: floating of 4 or 8 bytes, integers of 1, 2, 4 or 8.
struct ScalarType {
  ScalarKind kind = ScalarKind::floating;
  std::size_t size = 4;  ///< Bytes.

  bool operator==(const ScalarType& other) const {
    return kind == other.kind && size == other.size;
  }
};

/// The type of the C++ type `Number`.
template <class Number>
constexpr ScalarType scalar_type_of() {
  static_assert(std::is_arithmetic_v<Number>, "a number");
  return {
      std::is_floating_point_v<Number>
          ? ScalarKind::floating
          : (std::is_signed_v<Number> ? ScalarKind::signed_integer : ScalarKind::unsigned_integer),
      sizeof(Number)};
}

/// The number that starts at `bytes`, on machines of any byte order; 8-byte integers are rounded to
/// double.
double decode_scalar(ScalarType type, ByteOrder order, const char* bytes);

/// Parses `word` as a number of `type`, independent of the locale ("nan" and "inf" too), and
/// appends its little-endian bytes. Returns false, and appends nothing, unless the whole word is a
/// number of this type.
bool append_scalar(std::string& bytes, ScalarType type, std::string_view word);

/// The same for a number. Returns false if `type` is an integer type that cannot represent `value`.
bool append_scalar(std::string& bytes, ScalarType type, double value);

/// The shortest text that `append_scalar` converts to the same bytes; `bytes` are little-endian.
std::string scalar_text(ScalarType type, const char* bytes);

}  // namespace croon

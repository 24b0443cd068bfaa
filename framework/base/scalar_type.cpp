#include "framework/base/scalar_type.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace croon {
namespace {

template <class T, class Bits>
double reinterpreted(Bits bits) {
  T value;
  static_assert(sizeof(value) == sizeof(bits), "the same bytes as another type");
  std::memcpy(&value, &bits, sizeof(value));
  return static_cast<double>(value);
}

double floating(std::uint64_t bits, std::size_t size) {
  return size == 4 ? reinterpreted<float>(static_cast<std::uint32_t>(bits))
                   : reinterpreted<double>(bits);
}

double signed_integer(std::uint64_t bits, std::size_t size) {
  switch (size) {
    case 1:
      return reinterpreted<std::int8_t>(static_cast<std::uint8_t>(bits));
    case 2:
      return reinterpreted<std::int16_t>(static_cast<std::uint16_t>(bits));
    case 4:
      return reinterpreted<std::int32_t>(static_cast<std::uint32_t>(bits));
    default:
      return reinterpreted<std::int64_t>(bits);
  }
}

/// Calls `work` with a number of `type`; its value is meaningless.
template <class Work>
auto with_type(ScalarType type, const Work& work) {
  const bool is_signed = type.kind == ScalarKind::signed_integer;
  if (type.kind == ScalarKind::floating) return type.size == 4 ? work(float{}) : work(double{});
  switch (type.size) {
    case 1:
      return is_signed ? work(std::int8_t{}) : work(std::uint8_t{});
    case 2:
      return is_signed ? work(std::int16_t{}) : work(std::uint16_t{});
    case 4:
      return is_signed ? work(std::int32_t{}) : work(std::uint32_t{});
    case 8:
      return is_signed ? work(std::int64_t{}) : work(std::uint64_t{});
    default:
      throw std::logic_error("a number of another size than 1, 2, 4 or 8 bytes");
  }
}

/// Memory is little-endian, because croon runs only on x86-64 (docs/design.md).
template <class Number>
void append_raw(std::string& bytes, Number number) {
  std::array<char, sizeof(Number)> raw;
  std::memcpy(raw.data(), &number, sizeof(Number));
  bytes.append(raw.data(), raw.size());
}

}  // namespace

double decode_scalar(ScalarType type, ByteOrder order, const char* bytes) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < type.size; ++i) {
    const std::size_t place = order == ByteOrder::little ? i : type.size - 1 - i;
    bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * place);
  }
  switch (type.kind) {
    case ScalarKind::floating:
      return floating(bits, type.size);
    case ScalarKind::signed_integer:
      return signed_integer(bits, type.size);
    case ScalarKind::unsigned_integer:
      return static_cast<double>(bits);
  }
  throw std::logic_error("decode_scalar: no such kind");
}

bool append_scalar(std::string& bytes, ScalarType type, std::string_view word) {
  // from_chars does not accept a plus sign.
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  return with_type(type, [&](auto number) {
    const char* const end = word.data() + word.size();
    const std::from_chars_result read = std::from_chars(word.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end) return false;
    append_raw(bytes, number);
    return true;
  });
}

bool append_scalar(std::string& bytes, ScalarType type, double value) {
  return with_type(type, [&](auto number) {
    using Number = decltype(number);
    if constexpr (std::is_integral_v<Number>) {
      // The bounds are compared as double: the 64-bit maximum rounds up to a value out of range.
      const double max_value = static_cast<double>(std::numeric_limits<Number>::max());
      const double min_value = static_cast<double>(std::numeric_limits<Number>::min());
      const bool is_in_range = sizeof(Number) < 8 ? value <= max_value : value < max_value;
      if (!(value >= min_value && is_in_range && value == std::trunc(value))) return false;
    }
    append_raw(bytes, static_cast<Number>(value));
    return true;
  });
}

std::string scalar_text(ScalarType type, const char* bytes) {
  return with_type(type, [&](auto number) {
    std::memcpy(&number, bytes, sizeof(number));
    std::array<char, 64> text{};
    return std::string(text.data(),
                       std::to_chars(text.data(), text.data() + text.size(), number).ptr);
  });
}

}  // namespace croon

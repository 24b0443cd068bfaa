#include "framework/io/scalar_type.hpp"

#include <cstdint>
#include <cstring>
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

}  // namespace croon

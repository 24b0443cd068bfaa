#pragma once

#include <cstddef>

namespace croon {

enum class ScalarKind { floating, signed_integer, unsigned_integer };
enum class ByteOrder { little, big };

/// The type of one number in a binary file: floating of 4 or 8 bytes, integers of 1, 2, 4 or 8.
struct ScalarType {
  ScalarKind kind = ScalarKind::floating;
  std::size_t size = 4;  ///< Bytes.
};

/// The number that starts at `bytes`, on machines of any byte order; integers of 8 bytes are
/// rounded to double.
double decode_scalar(ScalarType type, ByteOrder order, const char* bytes);

}  // namespace croon

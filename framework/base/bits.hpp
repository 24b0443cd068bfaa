#pragma once

#include <cstdint>

namespace croon {

/// The number of set bits. Without the popcnt instruction, which not every x86-64 processor has,
/// the compiler's builtin is a function call.
inline int count_bits(std::uint64_t bits) {
  bits -= (bits >> 1U) & 0x5555555555555555ULL;
  bits = (bits & 0x3333333333333333ULL) + ((bits >> 2U) & 0x3333333333333333ULL);
  bits = (bits + (bits >> 4U)) & 0x0f0f0f0f0f0f0f0fULL;
  return static_cast<int>((bits * 0x0101010101010101ULL) >> 56U);
}

}  // namespace croon

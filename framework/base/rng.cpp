#include "framework/base/rng.hpp"

#include <cmath>
#include <stdexcept>

namespace croon {
namespace {

/// The finaliser of SplitMix64 (Steele, Lea, Flood 2014): every input bit affects every output bit.
std::uint64_t mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// FNV-1a, 64 bits.
std::uint64_t hash(std::string_view word) {
  std::uint64_t value = 0xcbf29ce484222325ULL;
  for (const char c : word) value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return value;
}

}  // namespace

StreamKey::StreamKey(std::uint64_t seed) : value_(mix(seed)) {}

StreamKey StreamKey::with(std::string_view word) const { return with(hash(word)); }

StreamKey StreamKey::with(std::uint64_t number) const {
  StreamKey key = *this;
  // Mixing before the sum makes the result depend on the order of the parts.
  key.value_ = mix(mix(value_) + number);
  return key;
}

double Rng::uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

double Rng::uniform(double low, double high) { return low + (high - low) * uniform(); }

std::uint64_t Rng::below(std::uint64_t count) {
  if (count == 0) throw std::logic_error("Rng::below: nothing to draw from");
  // Values in the last, incomplete block of `count` would favour small results: draw again.
  const std::uint64_t excess = (UINT64_MAX % count + 1) % count;
  std::uint64_t draw = bits();
  while (draw > UINT64_MAX - excess) draw = bits();
  return draw % count;
}

double Rng::normal() {
  for (;;) {
    const double u = uniform(-1.0, 1.0);
    const double v = uniform(-1.0, 1.0);
    const double s = u * u + v * v;
    if (s > 0.0 && s < 1.0) return u * std::sqrt(-2.0 * std::log(s) / s);
  }
}

}  // namespace croon

#pragma once

#include <cstdint>
#include <random>
#include <string_view>

namespace croon {

/// Names a stream of random numbers: a seed, followed by words and numbers that describe the
/// purpose of the stream. Two different paths give independent streams; the same path gives the
/// same bits on every machine.
///
///     Rng rng(StreamKey(seed).with(scene).with(sensor).with(trial));
class StreamKey {
 public:
  explicit StreamKey(std::uint64_t seed);
  StreamKey with(std::string_view word) const;
  StreamKey with(std::uint64_t number) const;
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_;
};

/// The only source of random numbers in croon: mt19937_64, whose bits the C++ standard specifies,
/// with our own distributions, because the standard ones differ between libraries. Not thread-safe:
/// one per thread.
class Rng {
 public:
  explicit Rng(const StreamKey& key) : engine_(key.value()) {}

  /// The next 64 bits.
  std::uint64_t bits() { return engine_(); }
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// Uniform in {0, ..., count - 1} without bias; `count` must be positive.
  std::uint64_t below(std::uint64_t count);
  /// Standard normal (Marsaglia's polar method).
  double normal();

 private:
  std::mt19937_64 engine_;
};

}  // namespace croon

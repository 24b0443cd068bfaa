#pragma once

#include <vector>

#include "framework/base/rng.hpp"

namespace croon::simulation {

/// An interval from `from` to `to`: a piece of a line, a time window, bounds of a uniform draw. The
/// unit is in the name of the variable.
struct Span {
  double from = 0.0;
  double to = 0.0;

  double length() const { return to - from; }
  double middle() const { return 0.5 * (from + to); }
  /// Whether `value` is in the half-open interval [from, to).
  bool contains(double value) const { return value >= from && value < to; }
};

/// Uniform in `span`.
inline double draw(Rng& rng, const Span& span) { return rng.uniform(span.from, span.to); }

/// True with the probability `share`.
inline bool chance(Rng& rng, double share) { return rng.uniform() < share; }

/// Uniform in {`low`, ..., `high`}.
inline int draw_int(Rng& rng, int low, int high) {
  return low + static_cast<int>(rng.below(
                   static_cast<std::uint64_t>(static_cast<std::int64_t>(high) - low + 1)));
}

/// 1 or -1 with equal probability.
inline double draw_sign(Rng& rng) { return chance(rng, 0.5) ? 1.0 : -1.0; }

/// One of `choices`, which must not be empty.
template <class T>
const T& pick(const std::vector<T>& choices, Rng& rng) {
  return choices[rng.below(choices.size())];
}

}  // namespace croon::simulation

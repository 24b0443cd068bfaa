#pragma once

#include <vector>

#include "framework/base/rng.hpp"

namespace croon::simulation {

/// True in `share` of the draws.
inline bool chance(Rng& rng, double share) { return rng.uniform() < share; }

/// Uniform in {`low`, ..., `high`}.
inline int draw_int(Rng& rng, int low, int high) {
  return low + static_cast<int>(rng.below(static_cast<std::uint64_t>(high - low + 1)));
}

/// 1 or -1, as likely as each other.
inline double draw_sign(Rng& rng) { return chance(rng, 0.5) ? 1.0 : -1.0; }

/// One of `choices`, which must not be empty.
template <class T>
const T& pick(const std::vector<T>& choices, Rng& rng) {
  return choices[rng.below(choices.size())];
}

}  // namespace croon::simulation

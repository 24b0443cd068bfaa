#pragma once

#include "framework/simulation/draws.hpp"
#include "framework/simulation/scenes/road_box.hpp"

namespace croon::simulation {

/// Uniform in `interval_m`.
inline double draw(Rng& rng, const Interval& interval_m) {
  return rng.uniform(interval_m.from_m, interval_m.to_m);
}

}  // namespace croon::simulation

#pragma once

#include "framework/simulation/scenes/builder.hpp"

namespace croon::simulation {

/// A bridge across the road over `along_m`, with nothing in it or behind its abutments. Add what
/// drives below it later.
void add_bridge(SceneBuilder& builder, const Interval& along_m, Rng rng);

/// A tunnel around the road over `along_m`; what drives in it may be added before and after.
void add_tunnel(SceneBuilder& builder, const Interval& along_m, Rng rng);

}  // namespace croon::simulation

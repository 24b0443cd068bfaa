#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/ground.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// A stretch of the road.
struct Stretch {
  double from_s_m = 0.0;
  double to_s_m = 0.0;
};

/// A tunnel over the carriageway and up to 3 m of its pavements: walls with niches or ribs, an
/// arched or flat ceiling, lamps, and a hill around it with a portal at either end. World
/// coordinates.
Mesh make_tunnel(const Ground& ground, const Stretch& stretch, Rng& rng);

/// A bridge across the road: deck, parapets, abutments with dams of up to 40 m behind them,
/// sometimes piers. World coordinates; `stretch` is what its deck covers.
Mesh make_bridge(const Ground& ground, const Stretch& stretch, Rng& rng);

}  // namespace croon::simulation

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

/// A tunnel over the carriageway and its pavements: walls, an arched or flat ceiling, lamps,
/// sometimes niches; portals at both ends. World coordinates.
Mesh make_tunnel(const Ground& ground, const Stretch& stretch, Rng& rng);

/// A bridge across the road: deck with edge beams and parapets, abutments or walls, sometimes
/// piers. World coordinates; `stretch` is what its deck covers.
Mesh make_bridge(const Ground& ground, const Stretch& stretch, Rng& rng);

}  // namespace croon::simulation

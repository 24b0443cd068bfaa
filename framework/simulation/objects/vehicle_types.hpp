#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// The vehicles by type, in the frame of Vehicle.
Mesh make_car(Rng& rng);
Mesh make_van(Rng& rng);
Mesh make_truck(Rng& rng);
Mesh make_bus(Rng& rng);

}  // namespace croon::simulation

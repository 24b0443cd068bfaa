#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// Somebody who stands or walks; faces x, z up, origin on the ground between the feet;
/// 1.2 to 1.95 m high.
Mesh make_person(Rng& rng);

}  // namespace croon::simulation

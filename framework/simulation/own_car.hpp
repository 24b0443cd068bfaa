#pragma once

#include "framework/simulation/mesh.hpp"
#include "framework/simulation/rig.hpp"

namespace croon::simulation {

/// The body of the car that carries the sensors, in the car's frame: x forward, origin on the road
/// below its middle. Smooth and without mirrors, like the one that the paper's samples show. Empty
/// where it is not visible.
Mesh make_own_car(const CarBody& body);

}  // namespace croon::simulation

#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

enum class VehicleType { car, van, truck, bus };

/// A vehicle in its own frame: x forward, y left, z up, origin on the ground below its middle.
struct Vehicle {
  Mesh mesh;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Length, width, height.
};

/// A vehicle with a shape, sizes and a colour of its own, on wheels.
Vehicle make_vehicle(VehicleType type, Rng& rng);

}  // namespace croon::simulation

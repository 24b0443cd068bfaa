#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// What sort of vehicle it is.
enum class VehicleType { car, van, truck, bus };

/// A vehicle in its own frame: x forward, y left, z up, origin on the ground below its middle.
struct Vehicle {
  Mesh mesh;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< Length, width with mirrors, height.
};

/// A vehicle with a shape, sizes and a coat of its own, on wheels: cars of 3.6 to 5 m, vans of 5 to
/// 6.5 m, trucks of 7 to 16 m and buses of 11 to 18 m. At most 1200 triangles.
Vehicle make_vehicle(VehicleType type, Rng& rng);

}  // namespace croon::simulation

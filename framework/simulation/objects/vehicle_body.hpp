#pragma once

#include "framework/simulation/objects/vehicle_parts.hpp"

namespace croon::simulation {

/// A body of one piece on two axles, as cars and vans have.
struct BodyShape {
  double length_m = 4.2;
  double width_m = 1.8;
  double clearance_m = 0.17;  ///< Below the sills.
  double nose_m = 0.75;       ///< Height of the bonnet's front edge.
  double tail_m = 0.9;        ///< Height of the lower body's rear edge.
  double front_axle_m = 1.3;  ///< x of the axle.
  double rear_axle_m = -1.3;
  double wheel_radius_m = 0.31;
  Cabin cabin;
};

/// The body with wheels in arches, bumpers, lights and mirrors.
void add_body(Mesh& mesh, const BodyShape& shape);

}  // namespace croon::simulation

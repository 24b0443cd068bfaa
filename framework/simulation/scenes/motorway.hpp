#pragma once

#include "framework/simulation/scenes/lanes.hpp"

namespace croon::simulation {

/// A road with a carriageway for each direction.
struct Motorway {
  RoadShape shape;
  Lanes lanes;
  double speed_mps = 28.0;
};

/// A motorway with 2 to 4 lanes each way.
Motorway draw_motorway(Rng& rng);

/// Places the car with the sensors in lane `index` of the motorway.
void put_car_on(SceneBuilder& builder, const Motorway& motorway, int index, const CarBody& car);

/// Adds barriers, noise walls, gantries, trees and traffic.
void add_motorway(SceneBuilder& builder, const Motorway& motorway);

}  // namespace croon::simulation

#pragma once

#include "framework/simulation/scenes/lanes.hpp"

namespace croon::simulation {

/// A road with separate carriageways.
struct Motorway {
  RoadShape shape;
  Lanes lanes;
  double speed_mps = 28.0;
};

/// A motorway with 2 to 4 lanes each way.
Motorway draw_motorway(Rng& rng);

/// Puts the car with the sensors into lane `index` of the motorway.
void put_car_on(SceneBuilder& builder, const Motorway& motorway, int index, const CarSpace& car);

/// Barriers, noise walls, gantries, trees and traffic.
void add_motorway(SceneBuilder& builder, const Motorway& motorway);

}  // namespace croon::simulation

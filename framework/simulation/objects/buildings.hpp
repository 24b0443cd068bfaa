#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// How large a building is.
struct BuildingSize {
  double width_m = 15.0;  ///< Along the road.
  double depth_m = 10.0;  ///< Away from it.
  int floors = 3;
};

/// A town house: windows in recesses on all sides, a door, a plinth, cornices, sometimes balconies
/// or a ground floor of shop windows. Its front is the plane y = 0, which looks towards -y; x along
/// the front from 0 to the width, z up from the ground at 0 (the walls go 1 m below it). Balconies
/// reach out to y = -1.2 m.
Mesh make_building(const BuildingSize& size, Rng& rng);

/// A family house in the same frame, with a pitched roof, sometimes a porch or a garage.
Mesh make_house(Rng& rng);

/// A hall: long walls with few openings, a flat roof; the same frame.
Mesh make_hall(const BuildingSize& size, Rng& rng);

}  // namespace croon::simulation

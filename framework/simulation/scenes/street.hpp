#pragma once

#include <array>

#include "framework/simulation/scenes/houses.hpp"
#include "framework/simulation/scenes/kerbside.hpp"
#include "framework/simulation/scenes/lanes.hpp"

namespace croon::simulation {

/// A random bend, slopes and surface.
RoadShape draw_road(Rng& rng);

/// A town street. Arrays have the left side first.
struct Street {
  RoadShape shape;
  Lanes lanes;
  std::array<bool, 2> has_parking = {true, true};
  std::array<double, 2> front_m = {14.0, 14.0};  ///< From the centre line to the houses.
  double speed_mps = 10.0;                       ///< Of the traffic.
};

/// A town street with at least `min_lanes` lanes each way.
Street draw_street(int min_lanes, Rng& rng);

/// Places the car with the sensors in lane `index` of the street.
void put_car_on(SceneBuilder& builder, const Street& street, int index, const CarBody& car);

/// Adds houses, parked cars, furniture, trees and people to one side of a road over `along_m`.
/// `key` is the random stream of this piece of the side; `index` is the side's index in the arrays
/// of the street.
void add_town_side(SceneBuilder& builder, const Street& street, const Roadside& side,
                   std::size_t index, const Span& along_m, const StreamKey& key);

/// Adds both sides of the street and its traffic.
void add_town(SceneBuilder& builder, const Street& street);

}  // namespace croon::simulation

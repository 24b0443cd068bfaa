#pragma once

#include <array>

#include "framework/simulation/scenes/fronts.hpp"
#include "framework/simulation/scenes/kerbside.hpp"
#include "framework/simulation/scenes/lanes.hpp"

namespace croon::simulation {

/// The bend, slopes and surface that any road has, drawn from their ranges.
RoadShape draw_road(Rng& rng);

/// A town street; arrays hold the left side first.
struct Street {
  RoadShape shape;
  Lanes lanes;
  std::array<bool, 2> has_parking = {true, true};
  std::array<double, 2> front_m = {14.0, 14.0};
  double speed_mps = 10.0;  ///< Of the traffic.
};

/// A town street with `least_lanes` each way at least.
Street draw_street(int least_lanes, Rng& rng);

/// Puts the car with the sensors into lane `index` of the street.
void put_car_on(SceneBuilder& builder, const Street& street, int index, const CarSpace& car);

/// Houses, parked cars, furniture, trees and people on one side of a road over `along_m`; `key` is
/// of this side and stretch. `index` is the side's in the street's arrays.
void add_town_side(SceneBuilder& builder, const Street& street, const Roadside& side,
                   std::size_t index, const Interval& along_m, const StreamKey& key);

/// The whole street with its traffic.
void add_town(SceneBuilder& builder, const Street& street);

}  // namespace croon::simulation

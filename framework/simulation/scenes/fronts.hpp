#pragma once

#include "framework/simulation/objects/buildings.hpp"
#include "framework/simulation/scenes/roadside.hpp"

namespace croon::simulation {

/// How town houses stand along a side.
struct Fronts {
  double out_m = 14.0;  ///< From the road's centre line to the fronts.
  int floors_low = 2;
  int floors_high = 6;
  double wall_to_wall = 0.5;  ///< Share of houses that touch the next one.
  double side_street = 0.15;  ///< Share of those after which a side street comes.
};

/// A row of town houses with gaps and side streets; beyond `kDetail_m` plain blocks.
void add_fronts(SceneBuilder& builder, const Roadside& side, const Interval& along_m,
                const Fronts& fronts, Rng rng);

/// Plain blocks farther away than the row, which are seen through its gaps.
void add_backdrop(SceneBuilder& builder, const Roadside& side, const Interval& along_m,
                  const Interval& out_m, Rng rng);

/// A building without details, in the frame of make_building.
Mesh make_block(const BuildingSize& size, Rng& rng);

/// How far along the road from the car things have details.
constexpr double kDetail_m = 60.0;

}  // namespace croon::simulation

#pragma once

#include "framework/simulation/scenes/builder.hpp"

namespace croon::simulation {

/// Maximum distance from the car along the road at which objects have details.
constexpr double kDetail_m = 60.0;

/// A row of town houses along a side.
struct Fronts {
  double out_m = 14.0;  ///< From the road's centre line to the fronts.
  int floors_low = 2;
  int floors_high = 6;
  double wall_to_wall = 0.5;  ///< Share of the houses that touch the next one.
  double side_street = 0.15;  ///< Share of the houses that are followed by a side street.
};

/// Adds a row of town houses with gaps and side streets; beyond `kDetail_m` they are plain blocks.
void add_fronts(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                const Fronts& fronts, Rng rng);

/// Adds plain blocks at distances within `out_m`, visible through the gaps of a row.
void add_backdrop(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                  const Span& out_m, Rng rng);

/// A building without details, in the frame of make_building.
Mesh make_block(const BuildingSize& size, Rng& rng);

/// Adds plots of family houses from `out_m` on: each has boundaries, a driveway, often with a car,
/// a house, trees and bushes.
void add_plots(SceneBuilder& builder, const Roadside& side, const Span& along_m, double out_m,
               const StreamKey& key);

}  // namespace croon::simulation

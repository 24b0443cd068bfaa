#pragma once

#include "framework/simulation/scenes/builder.hpp"

namespace croon::simulation {

/// Adds a row of parked cars and vans with their middles at the distance `out_m`; `share` is the
/// share of occupied parking spaces.
void add_parked_row(SceneBuilder& builder, const Roadside& side, const Span& along_m, double out_m,
                    double share, Rng rng);

/// Adds up to `count` people between the distances `out_m`. Some of them walk along the side.
void add_people(SceneBuilder& builder, const Roadside& side, const Span& along_m, const Span& out_m,
                int count, Rng rng);

/// A pavement of a town or a suburb.
struct Pavement {
  double kerb_m = 5.0;  ///< Distance from the centre line to its kerb.
  double width_m = 3.5;
  double tree_share = 0.6;  ///< Share of the positions for trees that have one.
};

/// Adds the furniture of a pavement: lamps, trees, signs, bollards, bins, benches, a bus stop.
void add_furniture(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                   const Pavement& pavement, const StreamKey& key);

}  // namespace croon::simulation

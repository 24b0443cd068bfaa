#pragma once

#include "framework/simulation/scenes/roadside.hpp"

namespace croon::simulation {

/// A row of parked cars and vans with their middles `out_m` out, `share` of the places filled.
void add_parked_row(SceneBuilder& builder, const Roadside& side, const Interval& along_m,
                    double out_m, double share, Rng rng);

/// `count` people between the distances `out_m`, some of whom walk along the side.
void add_people(SceneBuilder& builder, const Roadside& side, const Interval& along_m,
                const Interval& out_m, int count, Rng rng);

/// A pavement of a town or a suburb.
struct Pavement {
  double kerb_m = 5.0;  ///< How far out of the centre line its kerb is.
  double width_m = 3.5;
  double tree_share = 0.6;  ///< Share of the places for trees that have one.
};

/// What stands on a pavement: lamps, trees, signs, bollards, bins, benches, a bus stop.
void add_furniture(SceneBuilder& builder, const Roadside& side, const Interval& along_m,
                   const Pavement& pavement, const StreamKey& key);

}  // namespace croon::simulation

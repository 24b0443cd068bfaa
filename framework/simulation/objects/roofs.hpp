#pragma once

#include "framework/simulation/objects/facade.hpp"

namespace croon::simulation {

/// A pitched roof with two slopes over a block.
struct PitchedRoof {
  double height_m = 6.0;  ///< Where the slopes meet the walls.
  double rise_m = 3.0;    ///< From there to the ridge.
  double eaves_m = 0.4;   ///< How far it overhangs the walls below its slopes.
  double verges_m = 0.0;  ///< How far it overhangs the gables.
  Material tiles = Material::brick;
};

/// `roof` over `block` with its gables; the walls `side` and opposite are below its slopes.
void add_pitched_roof(Mesh& mesh, const Block& block, std::size_t side, const PitchedRoof& roof,
                      Material gable);

/// A flat roof over `block`, `height_m` above its foot, with a parapet of `parapet_m` that goes on
/// from the walls.
void add_flat_roof(Mesh& mesh, const Block& block, double height_m, double parapet_m,
                   Material parapet);

}  // namespace croon::simulation

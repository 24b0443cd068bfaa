#pragma once

#include <cstdint>

#include "framework/params/table.hpp"
#include "framework/simulation/noise.hpp"
#include "framework/simulation/rig.hpp"
#include "framework/simulation/scene_kind.hpp"

namespace croon::simulation {

/// All that decides what simulated scenes are, but for their number. Scene k follows from it and
/// from k alone.
struct Recipe {
  Rig rig = rigs().front().second;
  Mix mix = paper_mix();
  Noise noise;
  int seed = 1;
};

/// The rows of a recipe: "rig", "mix", "noise", "seed".
const params::Table<Recipe>& recipe_table();

}  // namespace croon::simulation

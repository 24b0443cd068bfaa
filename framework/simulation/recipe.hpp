#pragma once

#include "framework/params/table.hpp"
#include "framework/simulation/rig.hpp"
#include "framework/simulation/scenes/scene.hpp"
#include "framework/simulation/sensor_model.hpp"

namespace croon::simulation {

/// Everything that determines the content of simulated scenes. Scene k depends only on the recipe
/// and k.
struct Recipe {
  Rig rig = rigs().front().second;
  Mix mix = paper_mix();
  Noise noise;
  double speed_mps = -1.0;  ///< Of the car in all scenes; if negative, each scene has its own.
  /// Number of consecutive scenes that are scans of one drive: they show the same world, in which
  /// the car and others have moved on by `scan_interval_s`.
  int scans_per_drive = 1;
  double scan_interval_s = 0.1;
  int seed = 1;
};

/// The rows of a recipe: "rig", "mix", "noise", "speed_mps", "seed".
const params::Table<Recipe>& recipe_table();

}  // namespace croon::simulation

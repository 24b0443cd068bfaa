#pragma once

#include "framework/simulation/scenes/roadside.hpp"

namespace croon::simulation {

/// Plots of family houses along a side, from `out_m` on: a boundary to the pavement, a driveway,
/// often with a car, a house set back, trees and bushes.
void add_plots(SceneBuilder& builder, const Roadside& side, const Interval& along_m, double out_m,
               const StreamKey& key);

}  // namespace croon::simulation

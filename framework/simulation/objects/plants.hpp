#pragma once

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// A tree of 4 to 12 m: trunk, a few boughs and a leafy crown; z up, origin at the foot of the
/// trunk.
Mesh make_tree(Rng& rng);

/// A round bush of 0.6 to 1.8 m.
Mesh make_bush(Rng& rng);

/// A cut hedge along x, `length_m` long from the origin on, about it in y; single leaves stand out
/// by up to 7 cm.
Mesh make_hedge(double length_m, double height_m, double width_m, Rng& rng);

/// Tufts of high grass along x, `length_m` long from the origin on, `width_m` wide about it.
Mesh make_tufts(double length_m, double width_m, Rng& rng);

}  // namespace croon::simulation

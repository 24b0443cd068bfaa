#pragma once

#include <array>

#include "framework/simulation/scenes/roadside.hpp"

namespace croon::simulation {

enum class BoundaryType {
  garden_wall,
  fence,
  hedge,
  noise_wall,
  guard_rail,
  jersey_barrier,
  tufts
};

/// A barrier that follows a line on the ground.
struct Boundary {
  BoundaryType type = BoundaryType::fence;
  double height_m = 1.2;  ///< Where the type has no height of its own.
};

/// The straight line in road coordinates between two places; it bends with the road. Their yaw is
/// of no account.
using RoadLine = std::array<Place, 2>;

/// Adds a barrier along `line` where all of it has room.
bool add_boundary(SceneBuilder& builder, const RoadLine& line, const Boundary& boundary, Rng& rng);

/// The same along a side, `out_m` out, in pieces of 10 m, each where it has room.
void add_boundary_pieces(SceneBuilder& builder, const Roadside& side, const Interval& along_m,
                         double out_m, const Boundary& boundary, Rng rng);

}  // namespace croon::simulation

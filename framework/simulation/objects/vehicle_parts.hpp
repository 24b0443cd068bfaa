#pragma once

#include <vector>

#include "framework/base/rng.hpp"
#include "framework/simulation/objects/solids.hpp"

namespace croon::simulation {

/// What an axle carries, metres.
struct Wheels {
  double radius_m = 0.3;
  double width_m = 0.2;
  double half_track_m = 0.8;  ///< From the middle of the car to the outside of a wheel.
};

/// Two wheels with hubs and an axle between them, at `x_m`; they stand on the ground.
void add_axle(Mesh& mesh, double x_m, const Wheels& wheels);

/// The upper part of a body, with windows from its belt line up.
struct Cabin {
  Level belt;                     ///< Where the windows begin.
  Level roof;                     ///< The roof's edge.
  double window_top_ratio = 0.9;  ///< Where the windows end between belt (0) and roof (1).
  std::vector<Span> windows;      ///< On each side, along the belt, in order.
  bool has_rear_window = true;
  Material material = Material::paint;
};

/// The windows and panels of `cabin`, and a slightly crowned roof; open at the belt.
void add_cabin(Mesh& mesh, const Cabin& cabin);

/// Mirrors on both sides, `half_width_m` from the middle, about `height_m` and at `x_m`;
/// `size_m` high.
void add_mirrors(Mesh& mesh, double x_m, double half_width_m, double height_m, double size_m);

/// Head lamps, tail lamps and number plates on the ends `ends` of a body, at `height_m`,
/// `half_width_m` being where the lamps end.
void add_lights(Mesh& mesh, const Span& ends, double half_width_m, double height_m);

/// Paint, or now and then bare metal.
Material draw_coat(Rng& rng);

}  // namespace croon::simulation

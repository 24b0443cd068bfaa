#pragma once

#include <vector>

#include "framework/simulation/objects/shapes.hpp"

// Parts that several types of vehicles share, in the frame of Vehicle.

namespace croon::simulation {

/// The wheels of an axle, metres.
struct Wheels {
  double radius_m = 0.3;
  double width_m = 0.2;
  double half_track_m = 0.8;  ///< From the middle of the car to the outside of a wheel.
};

/// Adds two wheels with hubs on the ground and an axle between them at `x_m`.
void add_axle(Mesh& mesh, double x_m, const Wheels& wheels);

/// The upper part of a body, from the lower edge of its windows (the belt line) up.
struct Cabin {
  Level belt;                     ///< The belt line.
  Level roof;                     ///< The edge of the roof.
  double window_top_ratio = 0.9;  ///< Upper edge of the windows, between belt (0) and roof (1).
  std::vector<Span> windows;      ///< Windows of either side, in x at the belt, in order.
  bool has_rear_window = true;
  Material material = Material::paint;
};

/// Adds the windows, the panels and a slightly crowned roof; the cabin is open at the belt.
void add_cabin(Mesh& mesh, const Cabin& cabin);

/// Adds mirrors of `size_m` on both sides at `x_m`, with their inner edges `half_width_m` from the
/// middle and their middles at `height_m`.
void add_mirrors(Mesh& mesh, double x_m, double half_width_m, double height_m, double size_m);

/// Adds head lamps, tail lamps and number plates at `height_m` to a body that reaches from
/// `ends.from` to `ends.to` in x; the outer edges of the lamps are `half_width_m` from the middle.
void add_lights(Mesh& mesh, const Span& ends, double half_width_m, double height_m);

/// A random paint, or bare metal.
Material draw_coat(Rng& rng);

/// The body of a car or a van with two axles.
struct BodyShape {
  double length_m = 4.2;
  double width_m = 1.8;
  double clearance_m = 0.17;  ///< Below the sills.
  double nose_m = 0.75;       ///< Height of the bonnet's front edge.
  double tail_m = 0.9;        ///< Height of the lower body's rear edge.
  double front_axle_m = 1.3;  ///< x of the axle.
  double rear_axle_m = -1.3;
  double wheel_radius_m = 0.31;
  Cabin cabin;
};

/// Adds the body with wheels in arches, bumpers, lights and mirrors.
void add_body(Mesh& mesh, const BodyShape& shape);

/// The vehicles by type.
Mesh make_car(Rng& rng);
Mesh make_van(Rng& rng);
Mesh make_truck(Rng& rng);
Mesh make_bus(Rng& rng);

}  // namespace croon::simulation

#pragma once

#include <vector>

#include "framework/simulation/scenes/builder.hpp"
#include "framework/simulation/scenes/roadside.hpp"

namespace croon::simulation {

/// The lanes of a road with traffic on the right.
struct Lanes {
  int each_way = 1;
  double width_m = 3.25;
  double half_median_m = 0.0;  ///< Half of what lies between the two directions.

  /// How far out of the centre line lane `index` runs, 0 the innermost.
  double middle_m(int index) const { return half_median_m + (index + 0.5) * width_m; }
  /// The outer edge of the outermost lane.
  double edge_m() const { return half_median_m + each_way * width_m; }
};

/// The lines between the lanes and, where `has_edges`, along their outer edges.
std::vector<LaneLine> lane_lines(const Lanes& lanes, bool has_edges);

/// Where the car with the sensors drives: lane `index`, off its middle by up to 0.35 m, turned by
/// up to 3 degrees.
Place draw_car_place(const Lanes& lanes, int index, Rng& rng);

/// How the vehicles of a lane follow each other.
struct Traffic {
  double speed_mps = 10.0;
  Interval gap_m = {8.0, 60.0};  ///< From bumper to bumper.
  double truck_share = 0.1;
  double bus_share = 0.05;
};

/// Vehicles in the lane `out_m` out on `side`, with the traffic there; fewer far away.
void add_traffic(SceneBuilder& builder, const Roadside& side, const Interval& along_m, double out_m,
                 const Traffic& traffic, Rng rng);

/// The same in all lanes of both directions.
void add_traffic(SceneBuilder& builder, const Lanes& lanes, const Interval& along_m,
                 const Traffic& traffic);

}  // namespace croon::simulation

#pragma once

#include <vector>

#include "framework/simulation/scenes/builder.hpp"

namespace croon::simulation {

/// The lanes of a road with traffic on the right.
struct Lanes {
  int each_way = 1;
  double width_m = 3.25;
  double half_median_m = 0.0;  ///< Half the width of the median.

  /// The distance from the centre line to the middle of lane `index`; 0 is the innermost.
  double middle_m(int index) const { return half_median_m + (index + 0.5) * width_m; }
  /// The distance from the centre line to the outer edge of the outermost lane.
  double edge_m() const { return half_median_m + each_way * width_m; }
};

/// The lines between the lanes and, if `has_edges`, along the outer edges.
std::vector<LaneLine> lane_lines(const Lanes& lanes, bool has_edges);

/// A pose of the car with the sensors in lane `index`: up to 0.35 m off the middle of the lane and
/// turned by up to 3 degrees.
RoadPose draw_car_pose(const Lanes& lanes, int index, Rng& rng);

/// The traffic of a lane.
struct Traffic {
  double speed_mps = 10.0;
  Span gap_m = {8.0, 60.0};  ///< Between two vehicles.
  double truck_share = 0.1;
  double bus_share = 0.05;
};

/// Adds vehicles to the lane at the distance `out_m` on `side`, in its driving direction.
void add_traffic(SceneBuilder& builder, const Roadside& side, const Span& along_m, double out_m,
                 const Traffic& traffic, Rng rng);

/// Adds vehicles to all lanes of both directions.
void add_traffic(SceneBuilder& builder, const Lanes& lanes, const Span& along_m,
                 const Traffic& traffic);

}  // namespace croon::simulation

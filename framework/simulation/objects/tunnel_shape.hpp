#pragma once

#include "framework/simulation/objects/along_path.hpp"
#include "framework/simulation/objects/structures.hpp"

namespace croon::simulation {

/// A drawn tunnel.
struct Tunnel {
  Span along_m;
  double kerb_m = 4.0;   ///< Where the carriageway ends.
  double wall_m = 6.0;   ///< Where the walls stand.
  double outer_m = 9.0;  ///< Where the hill around it ends.
  double height_m = 6.0;
  double top_m = 8.0;  ///< Of the hill.
  bool is_arched = false;
  double niches_m = 0.0;  ///< From one niche to the next; 0: none.
  double ribs_m = 0.0;    ///< The same of ribs.
  double lamps_m = 8.0;   ///< The same of lamps.
  double niche_depth_m = 0.8;
};

/// A tunnel over `stretch` of the road of `shape`.
Tunnel draw_tunnel(const RoadShape& shape, const Stretch& stretch, Rng& rng);

/// The ceiling from wall to wall: left of the centre line and above the carriageway, metres.
Profile ceiling_of(const Tunnel& tunnel);

}  // namespace croon::simulation

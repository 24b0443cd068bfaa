#include "framework/simulation/objects/tunnel_shape.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/draws.hpp"

namespace croon::simulation {

Tunnel draw_tunnel(const RoadShape& shape, const Stretch& stretch, Rng& rng) {
  Tunnel tunnel;
  tunnel.along_m = {stretch.from_s_m, stretch.to_s_m};
  tunnel.kerb_m = shape.half_width_m;
  tunnel.wall_m =
      shape.half_width_m + std::clamp(shape.pavement_width_m, 0.8, 3.0) + rng.uniform(0.0, 0.4);
  tunnel.outer_m = tunnel.wall_m + rng.uniform(2.0, 6.0);
  tunnel.is_arched = chance(rng, 0.5);
  tunnel.height_m = rng.uniform(5.2, 6.5) + (tunnel.is_arched ? 0.8 : 0.0);
  tunnel.top_m = tunnel.height_m + rng.uniform(1.0, 3.0);
  const bool has_niches = chance(rng, 0.5);
  const double every_m = rng.uniform(8.0, 16.0);
  tunnel.niches_m = has_niches ? 2.0 * every_m : 0.0;
  tunnel.ribs_m = has_niches ? 0.0 : every_m;
  tunnel.lamps_m = rng.uniform(6.0, 12.0);
  tunnel.niche_depth_m = rng.uniform(0.5, 1.0);
  return tunnel;
}

Profile ceiling_of(const Tunnel& tunnel) {
  const double wall_m = tunnel.wall_m;
  if (!tunnel.is_arched) return {{wall_m, tunnel.height_m}, {-wall_m, tunnel.height_m}};
  constexpr int kSides = 12;
  constexpr double kClear_m = 4.8;
  // Half an ellipse from where it begins to the top, high enough for lorries above the kerbs.
  const double ratio = std::sqrt(1.0 - std::pow(tunnel.kerb_m / wall_m, 2));
  const double spring_m = std::max(2.8, (kClear_m - ratio * tunnel.height_m) / (1.0 - ratio));
  Profile ceiling;
  for (int i = 0; i <= kSides; ++i) {
    const double angle = kPi * i / kSides;
    ceiling.emplace_back(i == kSides ? -wall_m : wall_m * std::cos(angle),
                         spring_m + (tunnel.height_m - spring_m) * std::sin(angle));
  }
  return ceiling;
}

}  // namespace croon::simulation

#include "framework/simulation/scenes/scene.hpp"

#include "framework/simulation/scenes/boundaries.hpp"
#include "framework/simulation/scenes/motorway.hpp"

namespace croon::simulation {
namespace {

/// Adds a bridge or a tunnel to some highways.
void add_overhead(SceneBuilder& builder, Rng& rng) {
  const double share = rng.uniform();
  const double from_m = rng.uniform(-40.0, 60.0);
  const double deck_m = rng.uniform(8.0, 16.0);
  const double tunnel_m = rng.uniform(-60.0, 45.0);
  const double length_m = rng.uniform(60.0, 130.0);
  if (share < 0.3) {
    add_bridge(builder, {from_m, from_m + deck_m}, rng);
  } else if (share < 0.32) {
    add_tunnel(builder, {tunnel_m, tunnel_m + length_m}, rng);
  }
}

}  // namespace

World make_highway(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("motorway"));
  const Motorway motorway = draw_motorway(rng);
  const int lane = draw_int(rng, 0, motorway.lanes.each_way - 1);
  SceneBuilder builder(motorway.shape, key);
  put_car_on(builder, motorway, lane, car);
  Rng overhead_rng(key.with("overhead"));
  add_overhead(builder, overhead_rng);
  add_motorway(builder, motorway);
  return builder.finish();
}

}  // namespace croon::simulation

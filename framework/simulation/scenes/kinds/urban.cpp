#include "framework/simulation/scenes/scene.hpp"

#include "framework/simulation/scenes/boundaries.hpp"
#include "framework/simulation/scenes/street.hpp"

namespace croon::simulation {

World make_urban(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("street"));
  const Street street = draw_street(1, rng);
  const int lane = draw_int(rng, 0, street.lanes.each_way - 1);
  const bool has_bridge = chance(rng, 0.05);
  const double bridge_m = rng.uniform(14.0, 45.0);
  const double deck_m = rng.uniform(8.0, 14.0);
  SceneBuilder builder(street.shape, key);
  put_car_on(builder, street, lane, car);
  if (has_bridge) add_bridge(builder, {bridge_m, bridge_m + deck_m}, Rng(key.with("bridge")));
  add_town(builder, street);
  return builder.finish();
}

}  // namespace croon::simulation

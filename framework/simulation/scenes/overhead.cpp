#include "framework/simulation/scenes/overhead.hpp"

#include "framework/simulation/objects/structures.hpp"

namespace croon::simulation {
namespace {

constexpr double kAside_m = 70.0;  ///< How far across the road a structure keeps its place clear.
constexpr double kTop_m = 15.0;

/// Keeps clear what is beside the carriageway and what is above it.
void keep_clear_around(SceneBuilder& builder, const Interval& along_m) {
  const Interval clear_m = {along_m.from_m - 1.0, along_m.to_m + 1.0};
  const double kerb_m = builder.shape().half_width_m;
  builder.keep_clear(road_box(clear_m, {-kAside_m, -kerb_m}, kTop_m));
  builder.keep_clear(road_box(clear_m, {kerb_m, kAside_m}, kTop_m));
  RoadBox above = road_box(clear_m, {-kerb_m, kerb_m}, kTop_m);
  above.min().z() = 4.2;
  builder.keep_clear(above);
}

}  // namespace

void add_bridge(SceneBuilder& builder, const Interval& along_m, Rng rng) {
  keep_clear_around(builder, along_m);
  builder.add(make_bridge(builder.ground(), {along_m.from_m, along_m.to_m}, rng));
}

void add_tunnel(SceneBuilder& builder, const Interval& along_m, Rng rng) {
  keep_clear_around(builder, along_m);
  builder.add(make_tunnel(builder.ground(), {along_m.from_m, along_m.to_m}, rng));
}

}  // namespace croon::simulation

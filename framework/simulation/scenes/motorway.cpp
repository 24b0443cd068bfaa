#include "framework/simulation/scenes/motorway.hpp"

#include "framework/simulation/scenes/boundaries.hpp"
#include "framework/simulation/scenes/street.hpp"

namespace croon::simulation {
namespace {

constexpr Span kMotorway_m = {-150.0, 150.0};

/// Adds one concrete barrier in the middle, or a guard rail for each direction.
void add_median(SceneBuilder& builder, const Motorway& motorway) {
  Rng rng(builder.key("median"));
  const std::array<Roadside, 2> sides = both_sides();
  if (chance(rng, 0.5)) {
    add_boundary_pieces(builder, sides[0], kMotorway_m, 0.0, {BoundaryType::jersey_barrier, 0.8},
                        rng);
    return;
  }
  const double out_m = motorway.lanes.half_median_m - 0.45;
  for (const Roadside& side : sides) {
    add_boundary_pieces(builder, side, kMotorway_m, out_m, {BoundaryType::guard_rail, 0.75}, rng);
  }
}

/// Adds the barrier, the verge and the plants behind it.
void add_verge(SceneBuilder& builder, const Roadside& side, double edge_m, const StreamKey& key) {
  Rng rng(key.with("verge"));
  const BoundaryType rail =
      chance(rng, 0.75) ? BoundaryType::guard_rail : BoundaryType::jersey_barrier;
  const double wall_m = edge_m + rng.uniform(5.0, 10.0);
  const double wall_height_m = rng.uniform(2.0, 3.5);
  const bool has_wall = chance(rng, 0.06);
  const double trees_m = rng.uniform(4.0, 14.0);
  const double hedge_share = rng.uniform(0.0, 0.8);
  add_boundary_pieces(builder, side, kMotorway_m, edge_m + 0.6, {rail, 0.8}, rng);
  if (has_wall) {
    add_boundary_pieces(builder, side, kMotorway_m, wall_m,
                        {BoundaryType::noise_wall, wall_height_m}, rng);
  }
  const double behind_m = has_wall ? wall_m + 2.0 : edge_m + 4.0;
  add_series(builder, side, kMotorway_m,
             {make_tree, 4, {trees_m, 1.6 * trees_m}, {behind_m, behind_m + 16.0}, 0.0, true},
             Rng(key.with("trees")));
  add_series(builder, side, {-60.0, 60.0},
             {make_bush, 4, {2.0, 7.0}, {edge_m + 2.0, behind_m + 3.0}, 0.0, true, hedge_share},
             Rng(key.with("bushes")));
  add_boundary_pieces(builder, side, {-30.0, 30.0}, edge_m + 1.6, {BoundaryType::tufts, 0.5},
                      Rng(key.with("tufts")));
  add_series(builder, side, kMotorway_m, {make_sign, 2, {25.0, 80.0}, {edge_m + 1.2, edge_m + 1.4}},
             Rng(key.with("signs")));
}

/// Adds a gantry to some motorways.
void add_gantry(SceneBuilder& builder, const Motorway& motorway) {
  Rng rng(builder.key("gantry"));
  const double s_m = rng.uniform(-60.0, 100.0);
  if (chance(rng, 0.6)) return;
  const double width_m = 2.0 * motorway.shape.half_width_m + 2.6;
  const Span along_m = {s_m - 1.0, s_m + 1.0};
  const double out_m = 0.5 * width_m;
  for (const Roadside& side : both_sides()) {
    if (!builder.is_free(side.box(along_m, {out_m - 0.6, out_m + 0.6}, 9.0))) return;
  }
  for (const Roadside& side : both_sides()) {
    builder.keep_clear(side.box(along_m, {out_m - 0.6, out_m + 0.6}, 9.0));
  }
  builder.add(make_gantry(width_m, rng), builder.ground().upright(s_m, 0.0, kWithTraffic_rad));
}

}  // namespace

Motorway draw_motorway(Rng& rng) {
  Motorway motorway;
  motorway.shape = draw_road(rng);
  motorway.shape.curvature_per_m *= 0.3;
  motorway.lanes.each_way = draw_int(rng, 2, 4);
  motorway.lanes.width_m = rng.uniform(3.4, 3.75);
  motorway.lanes.half_median_m = rng.uniform(0.9, 2.2);
  motorway.shape.half_width_m = motorway.lanes.edge_m() + rng.uniform(0.6, 3.0);
  motorway.shape.kerb_height_m = 0.0;
  motorway.shape.pavement_width_m = 0.0;
  motorway.shape.lines = lane_lines(motorway.lanes, true);
  motorway.speed_mps = chance(rng, 0.1) ? rng.uniform(0.0, 8.0) : rng.uniform(20.0, 34.0);
  return motorway;
}

void put_car_on(SceneBuilder& builder, const Motorway& motorway, int index, const CarBody& car) {
  Rng rng(builder.key("car"));
  RoadPose pose = draw_car_pose(motorway.lanes, index, rng);
  pose.yaw_rad *= 0.5;
  const double speed_mps = motorway.speed_mps * rng.uniform(0.85, 1.1);
  builder.put_car(pose, car, speed_mps);
}

void add_motorway(SceneBuilder& builder, const Motorway& motorway) {
  Traffic traffic;
  traffic.speed_mps = motorway.speed_mps;
  traffic.gap_m = {6.0 + 0.5 * motorway.speed_mps, 30.0 + 3.0 * motorway.speed_mps};
  traffic.truck_share = 0.2;
  traffic.bus_share = 0.03;
  add_traffic(builder, motorway.lanes, kMotorway_m, traffic);
  add_gantry(builder, motorway);
  add_median(builder, motorway);
  std::uint64_t number = 0;
  for (const Roadside& side : both_sides()) {
    add_verge(builder, side, motorway.shape.half_width_m, builder.key("side").with(number++));
  }
}

}  // namespace croon::simulation

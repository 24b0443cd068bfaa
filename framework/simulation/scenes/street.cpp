#include "framework/simulation/scenes/street.hpp"

#include <algorithm>
#include <cmath>

#include "framework/simulation/scenes/boundaries.hpp"

namespace croon::simulation {
namespace {

constexpr double kParking_m = 2.2;  ///< Width of a strip for parked cars.
constexpr Span kTown_m = {-115.0, 115.0};

/// Adds front gardens behind a hedge, a fence or a wall, if there is room for them.
void add_front_gardens(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                       const Span& out_m, const StreamKey& key) {
  Rng rng(key.with("front gardens"));
  if (out_m.length() < 1.5 || chance(rng, 0.5)) return;
  const BoundaryType type = pick<BoundaryType>(
      {BoundaryType::garden_wall, BoundaryType::fence, BoundaryType::hedge}, rng);
  const double height_m = rng.uniform(0.6, 1.0);
  for (double from_m = along_m.from; from_m < along_m.to;) {
    const double to_m = from_m + rng.uniform(5.0, 14.0);
    if (std::abs(from_m) < kDetail_m) {
      const double end_m = std::min(to_m, along_m.to);
      add_boundary(builder, {side.at(from_m, out_m.from), side.at(end_m, out_m.from)},
                   {type, height_m}, rng);
    }
    from_m = to_m + rng.uniform(1.2, 4.0);
  }
}

}  // namespace

RoadShape draw_road(Rng& rng) {
  RoadShape shape;
  const bool is_straight = chance(rng, 0.5);
  const double size = rng.uniform(0.1, 1.0);
  const double bend = size * draw_sign(rng);
  if (!is_straight) shape.curvature_per_m = bend / 120.0;
  shape.grade = rng.uniform(-0.04, 0.04);
  shape.banking = rng.uniform(-0.02, 0.02) + 1.5 * shape.curvature_per_m;
  shape.crown = rng.uniform(0.0, 0.025);
  shape.roughness_m = rng.uniform(0.002, 0.005);
  shape.kerb_height_m = rng.uniform(0.08, 0.15);
  shape.behind_roughness_m = rng.uniform(0.01, 0.04);
  return shape;
}

Street draw_street(int min_lanes, Rng& rng) {
  Street street;
  street.shape = draw_road(rng);
  const int lanes = chance(rng, 0.65) ? 1 : 2;
  street.lanes.each_way = std::max(min_lanes, lanes);
  street.lanes.width_m = rng.uniform(3.1, 3.75);
  street.shape.half_width_m = street.lanes.edge_m() + kParking_m;
  street.shape.pavement_width_m = rng.uniform(2.8, 5.0);
  street.shape.lines = lane_lines(street.lanes, true);
  street.shape.behind = chance(rng, 0.6) ? Material::paving : Material::grass;
  street.speed_mps = chance(rng, 0.25) ? 0.0 : rng.uniform(4.0, 14.0);
  const double kerb_m = street.shape.half_width_m + street.shape.pavement_width_m;
  for (std::size_t i = 0; i < 2; ++i) {
    street.has_parking[i] = chance(rng, 0.75);
    const double min_front_m = std::max(kerb_m, 12.0);
    street.front_m[i] = rng.uniform(min_front_m, min_front_m + 5.0);
  }
  return street;
}

void put_car_on(SceneBuilder& builder, const Street& street, int index, const CarBody& car) {
  Rng rng(builder.key("car"));
  const RoadPose pose = draw_car_pose(street.lanes, index, rng);
  const double turn_rate_radps = 0.01 * street.speed_mps * rng.uniform(-0.5, 0.5);
  const double speed_mps = street.speed_mps * rng.uniform(0.8, 1.2);
  builder.put_car(pose, car, speed_mps, turn_rate_radps);
}

void add_town_side(SceneBuilder& builder, const Street& street, const Roadside& side,
                   std::size_t index, const Span& along_m, const StreamKey& key) {
  const double kerb_m = street.shape.half_width_m;
  const Pavement pavement = {kerb_m, street.shape.pavement_width_m, 0.75};
  const double back_m = kerb_m + pavement.width_m;
  Rng rng(key.with("side"));
  Fronts fronts;
  fronts.out_m = street.front_m[index];
  fronts.floors_high = draw_int(rng, 2, 6);
  fronts.wall_to_wall = rng.uniform(0.1, 0.5);
  const double parked_share = rng.uniform(0.05, 0.5);
  const int people = draw_int(rng, 1, 9);
  add_fronts(builder, side, along_m, fronts, Rng(key.with("fronts")));
  const Span far_m = {fronts.out_m + 35.0, fronts.out_m + 60.0};
  add_backdrop(builder, side, along_m, far_m, Rng(key.with("backdrop")));
  add_front_gardens(builder, side, along_m, {back_m + 0.3, fronts.out_m}, key);
  if (street.has_parking[index]) {
    add_parked_row(builder, side, along_m, kerb_m - 1.12, parked_share, Rng(key.with("parked")));
  }
  add_furniture(builder, side, along_m, pavement, key);
  const Span near_m = {std::max(along_m.from, -40.0), std::min(along_m.to, 50.0)};
  add_people(builder, side, near_m, {kerb_m + 1.2, back_m - 0.4}, people, Rng(key.with("people")));
}

void add_town(SceneBuilder& builder, const Street& street) {
  Traffic traffic;
  traffic.speed_mps = street.speed_mps;
  traffic.truck_share = 0.05;
  traffic.bus_share = 0.03;
  traffic.gap_m = {15.0, 90.0};
  if (street.speed_mps == 0.0) traffic.gap_m = {2.5, 40.0};
  add_traffic(builder, street.lanes, kTown_m, traffic);
  std::size_t index = 0;
  for (const Roadside& side : both_sides()) {
    add_town_side(builder, street, side, index, kTown_m, builder.key("side").with(index));
    ++index;
  }
}

}  // namespace croon::simulation

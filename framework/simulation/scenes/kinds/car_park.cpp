#include "framework/simulation/scenes/scene.hpp"

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/shapes.hpp"
#include "framework/simulation/scenes/boundaries.hpp"
#include "framework/simulation/scenes/houses.hpp"
#include "framework/simulation/scenes/kerbside.hpp"

namespace croon::simulation {
namespace {

constexpr double kBay_m = 2.6;
constexpr double kBayDepth_m = 5.2;

/// Double rows of bays along the road with lanes between them. The car is in the middle lane.
struct Bays {
  double lane_m = 6.5;  ///< Width of the lanes.
  int rows = 2;         ///< Double rows on each side of the car.
  Span along_m = {-40.0, 40.0};
  double share = 0.6;  ///< Share of the bays that are occupied.

  double period_m() const { return lane_m + 2.0 * kBayDepth_m; }
  /// The middle of the double row `row`: 0 and up are to the left, -1 and down to the right.
  double row_m(int row) const { return (row + 0.5) * period_m(); }
  double edge_m() const { return (rows + 0.3) * period_m(); }
};

Bays draw_bays(Rng& rng) {
  Bays bays;
  bays.lane_m = rng.uniform(6.5, 9.0);
  bays.rows = 1;
  bays.along_m = {-rng.uniform(20.0, 45.0), rng.uniform(20.0, 55.0)};
  bays.share = rng.uniform(0.1, 0.4);
  return bays;
}

RoadShape draw_asphalt(const Bays& bays, Rng& rng) {
  RoadShape shape;
  shape.half_width_m = bays.edge_m();
  shape.grade = rng.uniform(-0.02, 0.02);
  shape.banking = rng.uniform(-0.02, 0.02);
  shape.roughness_m = rng.uniform(0.002, 0.005);
  shape.kerb_height_m = 0.0;
  shape.pavement_width_m = rng.uniform(0.0, 4.0);
  for (int row = -bays.rows; row < bays.rows; ++row) {
    shape.lines.push_back({bays.row_m(row), false});
  }
  return shape;
}

/// Adds cars to both halves of a double row, nose in or nose out.
void add_bay_cars(SceneBuilder& builder, const Bays& bays, double row_m, Rng rng) {
  for (double s_m = bays.along_m.from; s_m < bays.along_m.to; s_m += kBay_m) {
    for (const double half : {-1.0, 1.0}) {
      if (!chance(rng, bays.share)) continue;
      const VehicleType type = chance(rng, 0.08) ? VehicleType::van : VehicleType::car;
      const Vehicle vehicle = make_vehicle(type, rng);
      const double d_m = row_m + half * (0.5 * kBayDepth_m + rng.uniform(0.0, 0.3));
      const double off_m = rng.uniform(-0.12, 0.12);
      const double turn_rad = rad_from_deg(rng.uniform(-2.0, 2.0));
      const double yaw_rad = 0.5 * kPi * draw_sign(rng) + turn_rad;
      builder.park(vehicle.mesh, {s_m + off_m, d_m, yaw_rad});
    }
  }
}

/// Adds an island of kerb stones with trees at each end of a row, and lamps between its halves.
void add_row_ends(SceneBuilder& builder, const Bays& bays, double row_m,
                  const std::vector<Mesh>& trees, const Mesh& lamp, Rng& rng) {
  for (const double end_m : {bays.along_m.from - 2.6, bays.along_m.to + 1.4}) {
    if (!builder.is_free(road_box({end_m - 1.0, end_m + 1.0}, {row_m - 4.7, row_m + 4.7}, 0.2))) {
      continue;
    }
    for (const double side : {-2.6, 2.6}) {
      const double turn_rad = rng.uniform(0.0, 2.0 * kPi);
      if (chance(rng, 0.7))
        builder.place_upright(pick(trees, rng), {end_m, row_m + side, turn_rad});
    }
    Mesh kerb;
    add_box(kerb, {-0.9, -4.6, -0.2}, {0.9, 4.6, 0.14}, Material::concrete);
    builder.add(kerb, builder.ground().on_slope(end_m, row_m, 0.0));
  }
  for (double s_m = bays.along_m.from + 6.5; s_m < bays.along_m.to; s_m += 22.0) {
    builder.place_upright(lamp, {s_m + 0.5 * kBay_m, row_m, 0.5 * kPi * draw_sign(rng)});
  }
}

/// Adds a bay for trolleys, with rails on three sides.
void add_trolley_bay(SceneBuilder& builder, const Bays& bays, Rng& rng) {
  const double s_m = rng.uniform(bays.along_m.from + 6.0, bays.along_m.to - 6.0);
  const int row = draw_int(rng, -1, 0);
  const double half = draw_sign(rng);
  const double near_m = bays.row_m(row) + half * 0.4;
  const double far_m = bays.row_m(row) + half * (kBayDepth_m - 0.3);
  const Boundary rails = {BoundaryType::fence, 1.1};
  add_boundary(builder, {RoadPose{s_m, near_m, 0.0}, RoadPose{s_m, far_m, 0.0}}, rails, rng);
  add_boundary(builder, {RoadPose{s_m + 2.4, near_m, 0.0}, RoadPose{s_m + 2.4, far_m, 0.0}}, rails,
               rng);
  add_boundary(builder, {RoadPose{s_m + 0.3, near_m, 0.0}, RoadPose{s_m + 2.1, near_m, 0.0}}, rails,
               rng);
}

/// Adds a hall on one side, and hedges or fences, trees and houses on both.
void add_surroundings(SceneBuilder& builder, const Bays& bays, const StreamKey& key) {
  Rng rng(key.with("hall"));
  const std::array<Roadside, 2> sides = both_sides();
  const std::size_t hall_side = rng.below(2);
  const BuildingSize size = {rng.uniform(40.0, 80.0), 30.0, draw_int(rng, 2, 3)};
  const double along_m = rng.uniform(-15.0, 25.0);
  const double front_m = bays.edge_m() + rng.uniform(0.5, 6.0);
  builder.place_upright(centred_along_x(make_hall(size, rng)),
                        sides[hall_side].at(along_m, front_m));
  const Span around_m = {bays.along_m.from - 12.0, bays.along_m.to + 14.0};
  for (std::size_t i = 0; i < 2; ++i) {
    const BoundaryType type = chance(rng, 0.5) ? BoundaryType::hedge : BoundaryType::fence;
    add_boundary_pieces(builder, sides[i], around_m, bays.edge_m() + 0.8, {type, 1.3},
                        Rng(key.with("edge").with(i)));
    add_series(builder, sides[i], {-70.0, 80.0},
               {make_tree, 3, {7.0, 14.0}, {bays.edge_m() + 3.0, bays.edge_m() + 9.0}, 0.0, true},
               Rng(key.with("edge trees").with(i)));
    Fronts fronts;
    fronts.out_m = bays.edge_m() + 18.0;
    fronts.floors_high = 4;
    fronts.wall_to_wall = 0.1;
    add_fronts(builder, sides[i], {-90.0, 100.0}, fronts, Rng(key.with("town").with(i)));
  }
}

}  // namespace

World make_car_park(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("bays"));
  const Bays bays = draw_bays(rng);
  const RoadShape shape = draw_asphalt(bays, rng);
  const double off_m = rng.uniform(-0.2, 0.2) * bays.lane_m;
  const double yaw_rad = rad_from_deg(rng.uniform(-3.0, 3.0));
  const double speed_mps = chance(rng, 0.4) ? 0.0 : rng.uniform(1.0, 4.0);
  const double turn_rate_radps = speed_mps * rng.uniform(-0.05, 0.05);
  SceneBuilder builder(shape, key);
  builder.put_car({0.0, off_m, yaw_rad}, car, speed_mps, turn_rate_radps);
  Rng ends_rng(key.with("row ends"));
  std::vector<Mesh> trees;
  for (int i = 0; i < 3; ++i) trees.push_back(make_tree(ends_rng));
  const Mesh lamp = make_lamp(ends_rng);
  Rng trolley_rng(key.with("trolleys"));
  if (chance(trolley_rng, 0.7)) add_trolley_bay(builder, bays, trolley_rng);
  for (int row = -bays.rows; row < bays.rows; ++row) {
    add_row_ends(builder, bays, bays.row_m(row), trees, lamp, ends_rng);
    const auto stream = static_cast<std::uint64_t>(static_cast<std::int64_t>(row) + bays.rows);
    add_bay_cars(builder, bays, bays.row_m(row), Rng(key.with("cars").with(stream)));
  }
  add_surroundings(builder, bays, key.with("surroundings"));
  Rng people_rng(key.with("people"));
  const int people = draw_int(people_rng, 2, 12);
  add_people(builder, both_sides()[0], bays.along_m, {-bays.edge_m(), bays.edge_m()}, people,
             people_rng);
  return builder.finish();
}

}  // namespace croon::simulation

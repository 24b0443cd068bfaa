#include "framework/simulation/scenes/scene.hpp"

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/scenes/street.hpp"

namespace croon::simulation {
namespace {

/// Two streets. The second crosses the first; its coordinates are those of a Roadside with
/// `is_across`.
struct Crossroads {
  Street along;
  Street across;

  /// The distance from the centre line of the crossing street to its houses.
  double corner_m(std::size_t side) const { return across.front_m[side]; }
};

Crossroads draw_crossroads(const StreamKey& key) {
  Rng along_rng(key.with("street"));
  Rng across_rng(key.with("street across"));
  Rng rng(key.with("crossing"));
  Crossroads roads;
  roads.along = draw_street(1, along_rng);
  roads.across = draw_street(1, across_rng);
  RoadShape& shape = roads.along.shape;
  shape.curvature_per_m *= 0.4;
  roads.across.shape.pavement_width_m = shape.pavement_width_m;
  const double half_width_m = roads.across.shape.half_width_m;
  for (double& front_m : roads.across.front_m) {
    front_m = std::max(front_m, half_width_m + shape.pavement_width_m + 0.5);
  }
  shape.crossing = Crossing{rng.uniform(-10.0, 26.0), half_width_m};
  return roads;
}

/// Places the car, which drives straight on or, inside the crossing, may turn.
void put_car(SceneBuilder& builder, const Crossroads& roads, const CarBody& car) {
  Rng rng(builder.key("car"));
  const Lanes& lanes = roads.along.lanes;
  const int lane = draw_int(rng, 0, lanes.each_way - 1);
  RoadPose pose = draw_car_pose(lanes, lane, rng);
  const double speed_mps = chance(rng, 0.4) ? 0.0 : rng.uniform(2.0, 9.0);
  const double turn = draw_sign(rng);
  const double turned_rad = rad_from_deg(rng.uniform(8.0, 60.0));
  const double turn_rate_radps = speed_mps / rng.uniform(8.0, 16.0);
  const bool is_turning = chance(rng, 0.6) && std::abs(roads.along.shape.crossing->s_m) <
                                                  roads.across.shape.half_width_m - 1.0;
  if (is_turning) pose.yaw_rad += turn * turned_rad;
  builder.put_car(pose, car, speed_mps, is_turning ? turn * turn_rate_radps : 0.0);
}

/// Adds cars that wait at the crossing or drive through it, on both roads.
void add_crossing_traffic(SceneBuilder& builder, const Crossroads& roads) {
  Rng rng(builder.key("lights"));
  const bool is_along_green = chance(rng, 0.5);
  const Traffic moving = {7.0, {8.0, 40.0}};
  const Traffic waiting = {0.0, {1.2, 12.0}};
  const double crossing_m = roads.along.shape.crossing->s_m;
  const double stop_m = roads.across.shape.half_width_m + 6.0;
  const double own_stop_m = roads.along.shape.half_width_m + 6.0;
  std::uint64_t stream = 0;
  for (const double sign : {1.0, -1.0}) {
    const Roadside across = {sign, true, crossing_m};
    const Roadside along = {sign, false, 0.0};
    for (const Span& arm_m : {Span{-90.0, -own_stop_m}, Span{own_stop_m, 90.0}}) {
      add_traffic(builder, across, arm_m, roads.across.lanes.middle_m(0),
                  is_along_green ? waiting : moving, Rng(builder.key("across").with(stream++)));
    }
    for (const Span& arm_m :
         {Span{-100.0, crossing_m - stop_m}, Span{crossing_m + stop_m, 110.0}}) {
      add_traffic(builder, along, arm_m, roads.along.lanes.middle_m(0),
                  is_along_green ? moving : waiting, Rng(builder.key("along").with(stream++)));
    }
  }
}

/// Adds traffic lights at the four corners and people who cross the road.
void add_corners(SceneBuilder& builder, const Crossroads& roads) {
  Rng rng(builder.key("corners"));
  const double crossing_m = roads.along.shape.crossing->s_m;
  const double beyond_m = roads.across.shape.half_width_m + 2.2;
  const double out_m = roads.along.shape.half_width_m + 2.2;
  const Mesh light = make_traffic_light(rng);
  for (const double ahead : {-1.0, 1.0}) {
    for (const Roadside& side : both_sides()) {
      // Each light faces the approaching vehicles.
      const double turn_rad = ahead * side.sign < 0.0 ? 0.0 : kToRoad_rad;
      builder.place_upright(light, side.at(crossing_m + ahead * beyond_m, out_m, turn_rad));
    }
    const int people = draw_int(rng, 0, 5);
    for (int i = 0; i < people; ++i) {
      const double s_m =
          crossing_m + ahead * (roads.across.shape.half_width_m + rng.uniform(2.5, 5.0));
      const double d_m = rng.uniform(-out_m, out_m);
      const double yaw_rad = 0.5 * kPi * draw_sign(rng);
      const double speed_mps = rng.uniform(0.9, 1.6);
      builder.drive(make_person(rng), {s_m, d_m, yaw_rad}, speed_mps);
    }
  }
}

/// Adds the sides of all four arms, starting at the corner houses.
void add_arms(SceneBuilder& builder, const Crossroads& roads) {
  const double crossing_m = roads.along.shape.crossing->s_m;
  const std::array<Roadside, 2> sides = both_sides();
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Span before_m = {-110.0, crossing_m - roads.corner_m(1)};
    const Span after_m = {crossing_m + roads.corner_m(0), 110.0};
    for (const Span& arm_m : {before_m, after_m}) {
      add_town_side(builder, roads.along, sides[i], i, arm_m, builder.key("arm").with(number++));
    }
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const Roadside side = {i == 0 ? 1.0 : -1.0, true, crossing_m};
    const Span right_m = {-85.0, -roads.along.front_m[1]};
    const Span left_m = {roads.along.front_m[0], 85.0};
    for (const Span& arm_m : {right_m, left_m}) {
      add_town_side(builder, roads.across, side, i, arm_m, builder.key("arm").with(number++));
    }
  }
}

}  // namespace

World make_crossing(const CarBody& car, const StreamKey& key) {
  const Crossroads roads = draw_crossroads(key);
  SceneBuilder builder(roads.along.shape, key);
  put_car(builder, roads, car);
  add_crossing_traffic(builder, roads);
  add_corners(builder, roads);
  add_arms(builder, roads);
  return builder.finish();
}

}  // namespace croon::simulation

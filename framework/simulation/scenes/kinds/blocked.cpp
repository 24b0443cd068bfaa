#include "framework/simulation/scenes/scene.hpp"

#include <utility>

#include "framework/base/angles.hpp"
#include "framework/simulation/scenes/motorway.hpp"
#include "framework/simulation/scenes/street.hpp"

namespace croon::simulation {
namespace {

/// Places the car and, 0.45 to 0.85 m beside it in the next lane, a truck or a bus.
void put_car_and_blocker(SceneBuilder& builder, const Lanes& lanes, const CarBody& car,
                         double speed_mps) {
  Rng rng(builder.key("blocker"));
  const VehicleType type = chance(rng, 0.5) ? VehicleType::truck : VehicleType::bus;
  Vehicle blocker = make_vehicle(type, rng);
  const double gap_m = rng.uniform(0.45, 0.85);
  const double side = draw_sign(rng);
  const double ahead_m = rng.uniform(-0.15, 0.15) * blocker.size_m.x();
  const double yaw_rad = rad_from_deg(rng.uniform(-0.5, 0.5));
  const double off_m = rng.uniform(-0.1, 0.1);
  // The two vehicles are on either side of the border between the two innermost lanes.
  const double apart_m = 0.5 * (car.width_m + blocker.size_m.y()) + gap_m;
  const double border_m = -(lanes.half_median_m + lanes.width_m);
  const double middle_m = border_m + 0.25 * (blocker.size_m.y() - car.width_m) * side + off_m;
  const RoadPose pose = {0.0, middle_m - 0.5 * side * apart_m, yaw_rad};
  const RoadPose beside = {ahead_m, pose.d_m + side * apart_m, yaw_rad};
  builder.drive(std::move(blocker.mesh), beside, speed_mps);
  builder.put_car(pose, car, speed_mps);
}

}  // namespace

World make_blocked(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("road"));
  if (chance(rng, 0.4)) {
    const Motorway motorway = draw_motorway(rng);
    SceneBuilder builder(motorway.shape, key);
    put_car_and_blocker(builder, motorway.lanes, car, motorway.speed_mps);
    add_motorway(builder, motorway);
    return builder.finish();
  }
  const Street street = draw_street(2, rng);
  SceneBuilder builder(street.shape, key);
  put_car_and_blocker(builder, street.lanes, car, street.speed_mps);
  add_town(builder, street);
  return builder.finish();
}

}  // namespace croon::simulation

#include "framework/simulation/scenes/scene.hpp"

#include "framework/simulation/scenes/boundaries.hpp"
#include "framework/simulation/scenes/lanes.hpp"

namespace croon::simulation {

World make_corridor(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("corridor"));
  Lanes lanes;
  lanes.width_m = rng.uniform(3.2, 3.6);
  RoadShape shape;
  shape.curvature_per_m = chance(rng, 0.6) ? 0.0 : rng.uniform(-1.0, 1.0) / 400.0;
  shape.grade = rng.uniform(-0.03, 0.03);
  shape.banking = rng.uniform(-0.02, 0.02);
  shape.roughness_m = rng.uniform(0.002, 0.005);
  shape.kerb_height_m = 0.0;
  shape.pavement_width_m = 0.0;
  shape.half_width_m = 2.0 * lanes.width_m + 2.5;
  shape.lines = lane_lines(lanes, false);
  const bool has_ceiling = chance(rng, 0.4);
  const double height_m = has_ceiling ? rng.uniform(4.8, 6.5) : rng.uniform(3.0, 8.0);
  SceneBuilder builder(shape, key);
  RoadPose pose = draw_car_pose(lanes, 0, rng);
  pose.yaw_rad *= 0.5;
  const double speed_mps = rng.uniform(4.0, 25.0);
  builder.put_car(pose, car, speed_mps);
  std::array<SmoothWall, 2> walls;
  const std::array<Roadside, 2> sides = both_sides();
  for (std::size_t i = 0; i < 2; ++i) {
    // 3.2 to 8 m from the middle of the car.
    walls[i].face_m = sides[i].sign * pose.d_m + rng.uniform(3.2, 8.0);
    walls[i].height_m = height_m;
    walls[i].along_m = {-140.0, 140.0};
    add_smooth_wall(builder, sides[i], walls[i]);
  }
  if (has_ceiling) add_ceiling(builder, walls);
  return builder.finish();
}

}  // namespace croon::simulation

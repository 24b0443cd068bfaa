#include "framework/simulation/scenes/scene.hpp"

#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/scenes/houses.hpp"

namespace croon::simulation {
namespace {

/// A wide paved square, or a track through a bare plain; almost level.
RoadShape draw_plain(Rng& rng) {
  RoadShape shape;
  const bool is_square = chance(rng, 0.5);
  shape.half_width_m = is_square ? rng.uniform(60.0, 90.0) : rng.uniform(3.0, 6.0);
  shape.grade = rng.uniform(-0.01, 0.01);
  shape.banking = rng.uniform(-0.01, 0.01);
  shape.roughness_m = rng.uniform(0.002, 0.005);
  shape.kerb_height_m = 0.0;
  shape.pavement_width_m = 0.0;
  shape.behind = is_square ? Material::paving : Material::grass;
  shape.behind_roughness_m = rng.uniform(0.004, 0.015);
  return shape;
}

/// A pose out of sight of a sensor with a range of 20 m.
RoadPose draw_far_pose(Rng& rng) {
  const double bearing_rad = rng.uniform(0.0, 2.0 * kPi);
  const double distance_m = rng.uniform(50.0, 95.0);
  return {distance_m * std::cos(bearing_rad), distance_m * std::sin(bearing_rad), bearing_rad};
}

}  // namespace

World make_empty(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("plain"));
  const RoadShape shape = draw_plain(rng);
  SceneBuilder builder(shape, key);
  const double d_m = rng.uniform(-1.0, 1.0);
  const double yaw_rad = rad_from_deg(rng.uniform(-3.0, 3.0));
  const double speed_mps = rng.uniform(0.0, 12.0);
  builder.put_car({0.0, d_m, yaw_rad}, car, speed_mps);
  Rng far_rng(key.with("far things"));
  const int blocks = draw_int(far_rng, 0, 2);
  const int trees = draw_int(far_rng, 0, 4);
  for (int i = 0; i < blocks; ++i) {
    const RoadPose pose = draw_far_pose(far_rng);
    const Mesh block = centred_along_x(make_block({20.0, 10.0, 3}, far_rng));
    builder.place_upright(block, pose);
  }
  for (int i = 0; i < trees; ++i) {
    const RoadPose pose = draw_far_pose(far_rng);
    builder.place_upright(make_tree(far_rng), pose);
  }
  return builder.finish();
}

}  // namespace croon::simulation

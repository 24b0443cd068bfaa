#include "framework/simulation/scenes/scene.hpp"

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/shapes.hpp"
#include "framework/simulation/scenes/boundaries.hpp"
#include "framework/simulation/scenes/houses.hpp"

namespace croon::simulation {
namespace {

/// The walls beside the car, left first.
std::array<SmoothWall, 2> draw_walls(const CarBody& car, Rng& rng) {
  const Span along_m = {-rng.uniform(35.0, 90.0), rng.uniform(35.0, 90.0)};
  std::array<SmoothWall, 2> walls;
  for (SmoothWall& wall : walls) {
    wall.along_m = along_m;
    wall.face_m = 0.5 * car.width_m + rng.uniform(0.55, 1.2);
    wall.height_m = rng.uniform(4.0, 10.0);
    wall.material = pick<Material>({Material::plaster, Material::brick, Material::concrete}, rng);
  }
  return walls;
}

/// Adds the only relief of the walls: a few thin pipes, away from the car.
void add_pipes(SceneBuilder& builder, const std::array<SmoothWall, 2>& walls, Rng& rng) {
  const std::array<Roadside, 2> sides = both_sides();
  for (std::size_t i = 0; i < 2; ++i) {
    const int pipes = draw_int(rng, 0, 3);
    for (int pipe = 0; pipe < pipes; ++pipe) {
      const double ahead = draw_sign(rng);
      const double along_m = ahead * rng.uniform(8.0, 30.0);
      const RoadPose pose = sides[i].at(along_m, walls[i].face_m - 0.06);
      Mesh mesh;
      add_cylinder(mesh, Eigen::Vector3d::Zero(), {0.0, 0.0, walls[i].height_m - 0.2}, 0.05, 0.05,
                   8, Material::metal);
      builder.add(mesh, builder.ground().upright(pose.s_m, pose.d_m, pose.yaw_rad));
    }
  }
}

}  // namespace

World make_narrow(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("alley"));
  const std::array<SmoothWall, 2> walls = draw_walls(car, rng);
  SceneBuilder builder(draw_road_between_walls({walls[0].face_m, walls[1].face_m}, 0.04, rng), key);
  const double yaw_rad = rad_from_deg(rng.uniform(-0.8, 0.8));
  const double speed_mps = rng.uniform(0.0, 4.0);
  builder.put_car({0.0, 0.0, yaw_rad}, car, speed_mps);
  Rng pipe_rng(key.with("pipes"));
  add_pipes(builder, walls, pipe_rng);
  const std::array<Roadside, 2> sides = both_sides();
  for (std::size_t i = 0; i < 2; ++i) {
    add_smooth_wall(builder, sides[i], walls[i]);
    Fronts fronts;
    fronts.out_m = 9.0;
    add_fronts(builder, sides[i], {walls[i].along_m.to + 12.0, 130.0}, fronts,
               Rng(key.with("fronts").with(i)));
  }
  return builder.finish();
}

}  // namespace croon::simulation

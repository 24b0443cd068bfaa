#include "framework/simulation/scenes/smooth_walls.hpp"

#include <algorithm>
#include <cmath>

#include "framework/simulation/objects/barriers.hpp"

namespace croon::simulation {
namespace {

constexpr double kThickness_m = 1.0;
constexpr double kStep_m = 4.0;

/// Places of the line at `d_m` over `along_m`, about every 4 m.
Path line_at(const Ground& ground, const Interval& along_m, double d_m, double above_m) {
  const int steps = static_cast<int>(std::ceil(along_m.length_m() / kStep_m));
  Path path;
  for (int i = 0; i <= steps; ++i) {
    const double s_m = along_m.from_m + along_m.length_m() * i / steps;
    path.push_back(ground.point(s_m, d_m, above_m));
  }
  return path;
}

}  // namespace

void add_smooth_wall(SceneBuilder& builder, const Roadside& side, const SmoothWall& wall) {
  constexpr double kBehind_m = 8.0;
  const double middle_m = wall.face_m + 0.5 * kThickness_m;
  const Path path = line_at(builder.ground(), wall.along_m, side.sign * middle_m, 0.0);
  builder.keep_clear(side.box(wall.along_m, {wall.face_m, wall.face_m + kBehind_m}, wall.height_m));
  builder.add(make_wall(path, wall.height_m, kThickness_m, wall.material));
}

void add_ceiling(SceneBuilder& builder, const std::array<SmoothWall, 2>& walls) {
  const double height_m = std::min(walls[0].height_m, walls[1].height_m);
  const Ground& ground = builder.ground();
  const Path left = line_at(ground, walls[0].along_m, walls[0].face_m, height_m);
  const Path right = line_at(ground, walls[0].along_m, -walls[1].face_m, height_m);
  Mesh ceiling;
  for (std::size_t i = 0; i + 1 < left.size(); ++i) {
    ceiling.add_quad(right[i], right[i + 1], left[i + 1], left[i], Material::concrete);
  }
  builder.add(ceiling);
}

}  // namespace croon::simulation

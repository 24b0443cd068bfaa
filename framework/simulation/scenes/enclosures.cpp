#include "framework/simulation/scenes/boundaries.hpp"

#include <algorithm>
#include <cmath>

namespace croon::simulation {
namespace {

constexpr double kThickness_m = 1.0;

/// Points of the line at `d_m` over `along_m`, at most 4 m apart.
Path line_at(const Ground& ground, const Span& along_m, double d_m, double above_m) {
  constexpr double kStep_m = 4.0;
  const int steps = static_cast<int>(std::ceil(along_m.length() / kStep_m));
  Path path;
  for (int i = 0; i <= steps; ++i) {
    const double s_m = along_m.from + along_m.length() * i / steps;
    path.push_back(ground.point(s_m, d_m, above_m));
  }
  return path;
}

/// Occupies the space beside the carriageway and above it.
void keep_clear_around(SceneBuilder& builder, const Span& along_m) {
  constexpr double kAside_m = 70.0;
  constexpr double kTop_m = 15.0;
  const Span clear_m = {along_m.from - 1.0, along_m.to + 1.0};
  const double kerb_m = builder.shape().half_width_m;
  builder.keep_clear(road_box(clear_m, {-kAside_m, -kerb_m}, kTop_m));
  builder.keep_clear(road_box(clear_m, {kerb_m, kAside_m}, kTop_m));
  RoadBox above = road_box(clear_m, {-kerb_m, kerb_m}, kTop_m);
  above.min().z() = 4.2;
  builder.keep_clear(above);
}

}  // namespace

void add_smooth_wall(SceneBuilder& builder, const Roadside& side, const SmoothWall& wall) {
  constexpr double kBehind_m = 8.0;
  const double middle_m = wall.face_m + 0.5 * kThickness_m;
  const Path path = line_at(builder.ground(), wall.along_m, side.sign * middle_m, 0.0);
  builder.keep_clear(side.box(wall.along_m, {wall.face_m, wall.face_m + kBehind_m}, wall.height_m));
  builder.add(make_wall(path, wall.height_m, kThickness_m, wall.material));
}

RoadShape draw_road_between_walls(const std::array<double, 2>& faces_m, double max_grade,
                                  Rng& rng) {
  RoadShape shape;
  shape.half_width_m = std::max(faces_m[0], faces_m[1]) + 0.5;
  shape.grade = rng.uniform(-max_grade, max_grade);
  shape.roughness_m = rng.uniform(0.002, 0.005);
  shape.kerb_height_m = 0.0;
  shape.pavement_width_m = 0.0;
  shape.behind = Material::paving;
  shape.behind_roughness_m = 0.005;
  return shape;
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

void add_bridge(SceneBuilder& builder, const Span& along_m, Rng rng) {
  keep_clear_around(builder, along_m);
  builder.add(make_bridge(builder.ground(), along_m, rng));
}

void add_tunnel(SceneBuilder& builder, const Span& along_m, Rng rng) {
  keep_clear_around(builder, along_m);
  builder.add(make_tunnel(builder.ground(), along_m, rng));
}

}  // namespace croon::simulation

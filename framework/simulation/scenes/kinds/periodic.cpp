#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/simulation/objects/shapes.hpp"
#include "framework/simulation/scenes/boundaries.hpp"
#include "framework/simulation/scenes/houses.hpp"
#include "framework/simulation/scenes/scene.hpp"

namespace croon::simulation {
namespace {

enum class Relief { niches, columns, racks, fence, vehicles };

/// Equal elements at equal distances along one side of the road.
struct ReliefRow {
  Relief relief = Relief::niches;
  double period_m = 3.0;
  double phase_m = 0.0;
  double face_m = 4.0;  ///< From the centre line to the elements.
  double depth_m = 0.5;
  double height_m = 4.0;
  bool has_wall = true;  ///< Whether there is a wall behind the elements.
  Mesh element;          ///< x along the road, y away from it, from y = 0 to the depth.
};

Mesh make_relief(const ReliefRow& row, Rng& rng) {
  Mesh mesh;
  const double half_m = 0.5 * rng.uniform(0.25, 0.7) * row.period_m;
  const double radius_m = rng.uniform(0.12, 0.35);
  const double rise_m = rng.uniform(1.0, 1.8);
  const double top_m = row.height_m;
  switch (row.relief) {
    case Relief::niches:
      add_box(mesh, {-half_m, 0.0, -0.5}, {half_m, row.depth_m, top_m}, Material::brick);
      break;
    case Relief::columns:
      add_cylinder(mesh, {0.0, radius_m, -0.5}, {0.0, radius_m, top_m}, radius_m, radius_m, 12,
                   Material::concrete);
      break;
    case Relief::racks:
      for (const double y_m : {0.0, row.depth_m}) {
        add_box(mesh, {-0.06, y_m - 0.05, -0.5}, {0.06, y_m + 0.05, top_m}, Material::metal);
      }
      for (double z_m = rise_m; z_m < top_m; z_m += rise_m) {
        add_box(mesh, {0.06, 0.0, z_m}, {row.period_m - 0.06, row.depth_m, z_m + 0.12},
                Material::metal);
        add_box(mesh, {0.5 * row.period_m - half_m, 0.1, z_m + 0.12},
                {0.5 * row.period_m + half_m, row.depth_m - 0.1, z_m + 0.12 + 0.5 * rise_m},
                Material::wood);
      }
      break;
    case Relief::fence:
      add_box(mesh, {-0.06, 0.0, -0.5}, {0.06, 0.12, top_m}, Material::wood);
      for (const double z_m : {0.4, 0.9}) {
        add_box(mesh, {0.06, 0.04, z_m}, {row.period_m - 0.06, 0.08, z_m + 0.12}, Material::wood);
      }
      break;
    case Relief::vehicles:
      break;
  }
  return mesh;
}

ReliefRow draw_relief_row(double min_face_m, Rng& rng) {
  ReliefRow row;
  // Niches are the most frequent element.
  row.relief = pick<Relief>({Relief::niches, Relief::niches, Relief::niches, Relief::columns,
                             Relief::racks, Relief::fence, Relief::vehicles},
                            rng);
  row.period_m = rng.uniform(1.5, 6.0);
  row.face_m = min_face_m + (chance(rng, 0.7) ? rng.uniform(0.0, 2.5) : rng.uniform(2.5, 8.0));
  row.depth_m = row.relief == Relief::racks ? rng.uniform(0.8, 1.2) : rng.uniform(0.2, 0.8);
  row.height_m = row.relief == Relief::fence ? rng.uniform(1.2, 2.0) : rng.uniform(3.0, 9.0);
  row.has_wall = row.relief == Relief::niches || chance(rng, 0.5);
  if (row.relief == Relief::columns) row.depth_m = rng.uniform(0.8, 3.0);
  if (row.relief == Relief::vehicles) {
    const Vehicle vehicle = make_vehicle(
        pick<VehicleType>({VehicleType::car, VehicleType::van, VehicleType::truck}, rng), rng);
    row.depth_m = vehicle.size_m.y() + 0.3;
    row.period_m = vehicle.size_m.x() + rng.uniform(0.5, 1.5);
    row.element.append(vehicle.mesh, {Eigen::Matrix3d::Identity(), {0.0, 0.5 * row.depth_m, 0.0}});
  } else {
    row.element = make_relief(row, rng);
  }
  row.phase_m = rng.uniform(0.0, row.period_m);
  return row;
}

void add_relief_row(SceneBuilder& builder, const Roadside& side, const Span& along_m,
                    const ReliefRow& row) {
  if (row.has_wall) {
    add_smooth_wall(builder, side,
                    {along_m, row.face_m + row.depth_m, row.height_m, Material::concrete});
  }
  // Vehicles have many triangles, and those far away hide each other.
  const double end_m = row.relief == Relief::vehicles ? 80.0 : 140.0;
  const double from_m = std::max(along_m.from, -end_m);
  const double to_m = std::min(along_m.to, end_m);
  const int from = static_cast<int>(std::ceil((from_m - row.phase_m) / row.period_m));
  for (int i = from; row.phase_m + (i + 1) * row.period_m <= to_m; ++i) {
    const RoadPose pose = side.at(row.phase_m + i * row.period_m, row.face_m);
    builder.add(row.element, builder.ground().upright(pose.s_m, pose.d_m, pose.yaw_rad));
  }
}

/// Walls across the road at both ends, and sometimes a ceiling: a hall.
void add_hall(SceneBuilder& builder, const Span& along_m, const std::array<ReliefRow, 2>& rows,
              bool has_ceiling) {
  const double left_m = rows[0].face_m + rows[0].depth_m;
  const double right_m = rows[1].face_m + rows[1].depth_m;
  const double height_m = std::min(rows[0].height_m, rows[1].height_m);
  for (const double s_m : {along_m.from, along_m.to}) {
    builder.add(
        make_wall({builder.ground().point(s_m, -right_m), builder.ground().point(s_m, left_m)},
                  height_m, 0.5, Material::concrete));
  }
  if (!has_ceiling) return;
  std::array<SmoothWall, 2> walls;
  walls[0] = {along_m, left_m, height_m, Material::concrete};
  walls[1] = {along_m, right_m, height_m, Material::concrete};
  add_ceiling(builder, walls);
}

}  // namespace

World make_periodic(const CarBody& car, const StreamKey& key) {
  Rng rng(key.with("rows"));
  const double min_face_m = 0.5 * car.width_m + 0.6;
  std::array<ReliefRow, 2> rows;
  rows[0] = draw_relief_row(min_face_m, rng);
  rows[1] = rows[0];
  const bool is_mirrored = chance(rng, 0.6);
  if (!is_mirrored) rows[1] = draw_relief_row(min_face_m, rng);
  rows[1].face_m = min_face_m + rng.uniform(0.0, 4.0);
  const bool is_long = chance(rng, 0.6);
  const bool is_hall = !is_long && chance(rng, 0.4);
  const bool has_ceiling = chance(rng, 0.5);
  const bool is_one_sided = !is_hall && chance(rng, 0.35);
  const Span along_m =
      is_long ? Span{-140.0, 140.0} : Span{-rng.uniform(8.0, 50.0), rng.uniform(8.0, 50.0)};
  const std::size_t only = rng.below(2);
  SceneBuilder builder(draw_road_between_walls({rows[0].face_m, rows[1].face_m}, 0.03, rng), key);
  const double heading_rad = rad_from_deg(rng.uniform(-2.0, 2.0));
  const double speed_mps = rng.uniform(0.0, 6.0);
  builder.put_car({0.0, 0.0, heading_rad}, car, speed_mps);
  if (is_hall) add_hall(builder, along_m, rows, has_ceiling);
  const std::array<Roadside, 2> sides = both_sides();
  for (std::size_t i = 0; i < 2; ++i) {
    if (!is_one_sided || i == only) add_relief_row(builder, sides[i], along_m, rows[i]);
  }
  // Objects that are not periodic: at most two near the car, and houses beyond the ends.
  Rng odd_rng(key.with("odd objects"));
  const int objects = chance(odd_rng, 0.35) ? draw_int(odd_rng, 1, 2) : 0;
  for (int i = 0; i < objects; ++i) {
    const Mesh mesh = chance(odd_rng, 0.5) ? make_bin(odd_rng) : make_person(odd_rng);
    const Roadside& side = sides[odd_rng.below(2)];
    const double ahead_m = draw_sign(odd_rng) * odd_rng.uniform(4.0, 15.0);
    const double out_m = odd_rng.uniform(0.5, min_face_m - 0.3);
    builder.place_upright(mesh, side.at(ahead_m, out_m, odd_rng.uniform(0.0, 2.0 * kPi)));
  }
  if (!is_long && !is_hall && chance(odd_rng, 0.5)) {
    for (std::size_t i = 0; i < 2; ++i) {
      Fronts fronts;
      fronts.out_m = odd_rng.uniform(8.0, 14.0);
      add_fronts(builder, sides[i], {along_m.to + 5.0, 130.0}, fronts,
                 Rng(key.with("fronts").with(i)));
    }
  }
  return builder.finish();
}

}  // namespace croon::simulation

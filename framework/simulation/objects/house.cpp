#include "framework/simulation/objects/facade.hpp"
#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

/// The dimensions and features of a family house.
struct House {
  Block block;
  int floors = 2;
  double floor_m = 2.8;
  double plinth_m = 0.3;
  Material wall = Material::plaster;
  bool has_gable_in_front = false;
  PitchedRoof roof;
  Opening window;
  int cells = 3;  ///< Of the front.
  int door_cell = 1;
  bool has_porch = false;

  double height_m() const { return floors * floor_m; }
  /// The cells of the floor `floor` of the wall `side`.
  Row row(int floor, std::size_t side) const {
    const double along_m = block.length_m(side);
    return {{0.0, along_m, floor * floor_m, (floor + 1) * floor_m},
            side == 0 ? cells : cells_of(along_m, 4.0, 3)};
  }
};

House draw_house(Rng& rng) {
  House house;
  house.block.width_m = rng.uniform(8.0, 14.0);
  house.block.depth_m = rng.uniform(7.0, 10.0);
  house.floors = draw_int(rng, 1, 2);
  house.floor_m = rng.uniform(2.6, 3.0);
  house.plinth_m = rng.uniform(0.2, 0.5);
  house.wall =
      pick<Material>({Material::plaster, Material::plaster, Material::brick, Material::wood}, rng);
  house.has_gable_in_front = chance(rng, 0.3);
  const double span_m = house.has_gable_in_front ? house.block.width_m : house.block.depth_m;
  house.roof.height_m = house.height_m();
  house.roof.rise_m = rng.uniform(0.3, 0.5) * span_m;
  house.roof.eaves_m = rng.uniform(0.3, 0.6);
  house.roof.verges_m = rng.uniform(0.2, 0.5);
  house.window.width_m = rng.uniform(1.0, 1.8);
  house.window.sill_m = rng.uniform(0.8, 1.0);
  house.window.height_m = rng.uniform(1.1, 1.4);
  house.window.recess_m = rng.uniform(0.1, 0.25);
  house.cells = cells_of(house.block.width_m, rng.uniform(2.6, 3.6), 5);
  house.door_cell = static_cast<int>(rng.below(static_cast<std::uint64_t>(house.cells)));
  house.has_porch = chance(rng, 0.4);
  return house;
}

/// Adds a step and a roof on two posts in front of the door.
void add_porch(Mesh& mesh, const House& house, const WallPart& door) {
  constexpr double kOut_m = 1.4;
  constexpr double kHalf_m = 1.1;
  constexpr double kPost_m = 0.14;
  const double middle_m = 0.5 * (door.left_m + door.right_m);
  const WallFrame front = house.block.wall(0);
  add_relief(mesh, front, {middle_m - kHalf_m, middle_m + kHalf_m, -0.5, 0.15}, kOut_m,
             Material::concrete);
  add_relief(mesh, front, {middle_m - kHalf_m, middle_m + kHalf_m, 2.4, 2.55}, kOut_m,
             Material::wood);
  for (const double x_m : {middle_m - kHalf_m, middle_m + kHalf_m - kPost_m}) {
    add_box(mesh, {x_m, -kOut_m, 0.15}, {x_m + kPost_m, kPost_m - kOut_m, 2.4}, Material::wood);
  }
}

void add_front(Mesh& mesh, const House& house) {
  const WallFrame front = house.block.wall(0);
  const Opening door = {1.1, 0.15, 2.1, 0.35, Material::wood};
  for (int floor = 0; floor < house.floors; ++floor) {
    const Row row = house.row(floor, 0);
    for (int i = 0; i < house.cells; ++i) {
      const bool is_door = floor == 0 && i == house.door_cell;
      add_opening(mesh, front, row.cell(i), is_door ? door : house.window, house.wall);
    }
  }
  const WallPart at_door = house.row(0, 0).cell(house.door_cell);
  if (house.has_porch) add_porch(mesh, house, at_door);
}

/// Adds the sides and the back with their plinth.
void add_other_walls(Mesh& mesh, const House& house) {
  for (std::size_t side = 1; side < Block::kWalls; ++side) {
    const WallFrame wall = house.block.wall(side);
    for (int floor = 0; floor < house.floors; ++floor) {
      add_openings(mesh, wall, house.row(floor, side), house.window, house.wall);
    }
    add_relief(mesh, wall, {0.0, house.block.length_m(side), -0.3, house.plinth_m}, 0.04,
               Material::concrete);
  }
}

/// Adds a chimney through the ridge, at `share` of its length.
void add_chimney(Mesh& mesh, const House& house, double share) {
  constexpr double kHalf_m = 0.35;
  const double x_m = (house.has_gable_in_front ? 0.5 : share) * house.block.width_m;
  const double y_m = (house.has_gable_in_front ? share : 0.5) * house.block.depth_m;
  add_box(mesh, {x_m - kHalf_m, y_m - kHalf_m, house.height_m()},
          {x_m + kHalf_m, y_m + kHalf_m, house.height_m() + house.roof.rise_m + 0.8},
          Material::brick);
}

/// Adds a garage at the right side of the house, behind its front.
void add_garage(Mesh& mesh, const House& house, double width_m) {
  constexpr double kBehind_m = 0.8;
  constexpr double kDepth_m = 5.5;
  constexpr double kHeight_m = 2.6;
  const Block block = {{house.block.width_m, kBehind_m, 0.0}, width_m, kDepth_m};
  const Opening gate = {width_m - 0.6, 0.0, 2.1, 0.15, Material::metal};
  add_opening(mesh, block.wall(0), {0.0, width_m, 0.0, kHeight_m}, gate, house.wall);
  add_wall(mesh, block.wall(1), {0.0, kDepth_m, 0.0, kHeight_m}, house.wall);
  add_wall(mesh, block.wall(2), {0.0, width_m, 0.0, kHeight_m}, house.wall);
  add_foundation(mesh, block);
  add_flat_roof(mesh, block, kHeight_m, 0.15, Material::concrete);
}

}  // namespace

Mesh make_house(Rng& rng) {
  const House house = draw_house(rng);
  const double chimney_share = rng.uniform(0.2, 0.8);
  const bool has_garage = chance(rng, 0.5);
  const double garage_m = rng.uniform(2.8, 3.4);
  Mesh mesh;
  add_foundation(mesh, house.block);
  add_front(mesh, house);
  add_other_walls(mesh, house);
  add_pitched_roof(mesh, house.block, house.has_gable_in_front ? 3 : 0, house.roof, house.wall);
  add_chimney(mesh, house, chimney_share);
  if (has_garage) add_garage(mesh, house, garage_m);
  return mesh;
}

}  // namespace croon::simulation

#include "framework/simulation/objects/town_house.hpp"

#include <algorithm>

namespace croon::simulation {
namespace {

void draw_openings(TownHouse& house, Rng& rng) {
  const double cell_m = house.size.width_m / house.cells;
  house.window.width_m = rng.uniform(0.32, 0.6) * cell_m;
  house.window.height_m = rng.uniform(1.3, 1.9);
  house.window.sill_m = rng.uniform(0.75, 0.95);
  house.window.recess_m = rng.uniform(0.1, 0.3);
  house.shop = house.window;
  house.shop.width_m = rng.uniform(0.75, 0.95) * cell_m;
  house.shop.sill_m = rng.uniform(0.25, 0.5);
  house.shop.height_m = house.floor_m - 0.8 - house.shop.sill_m;
  house.door = house.window;
  house.door.width_m = rng.uniform(1.0, 1.6);
  house.door.sill_m = 0.0;
  house.door.height_m = 2.3;
  house.door.recess_m = rng.uniform(0.35, 0.6);
  house.door.pane = Material::wood;
}

void draw_features(TownHouse& house, Rng& rng) {
  const auto cells = static_cast<std::uint64_t>(house.cells);
  house.door_cell = static_cast<int>(rng.below(cells));
  const int bay_cell = static_cast<int>(rng.below(cells));
  house.has_balconies = chance(rng, 0.3);
  const bool has_bay = chance(rng, 0.3) && !house.has_balconies && house.full_floors > 2;
  house.bay_cell = has_bay ? bay_cell : -1;
  house.has_shops = chance(rng, 0.35);
  house.has_bands = chance(rng, 0.5);
  house.plinth_m = std::min(rng.uniform(0.3, 0.7), house.has_shops ? house.shop.sill_m : 0.7);
  house.relief_m = rng.uniform(0.03, 0.07);
  house.cornice_m = rng.uniform(0.12, 0.3);
  house.rise_m = rng.uniform(0.25, 0.45) * house.size.depth_m;
}

TownHouse draw_town_house(const BuildingSize& size, Rng& rng) {
  // On very large fronts, windows become wider instead of more numerous.
  constexpr int kMaxCells = 44;
  TownHouse house;
  house.size = size;
  house.wall = pick<Material>(
      {Material::brick, Material::plaster, Material::plaster, Material::concrete}, rng);
  house.floor_m = rng.uniform(2.8, 3.8);
  const double cell_m = rng.uniform(2.2, 3.5);
  house.cells = cells_of(size.width_m, cell_m, std::max(1, kMaxCells / size.floors));
  house.top = pick<Top>({Top::flat, Top::flat, Top::pitched, Top::pitched, Top::set_back}, rng);
  const bool is_large = size.floors > 2 && std::min(size.width_m, size.depth_m) > 6.0;
  if (house.top == Top::set_back && !is_large) house.top = Top::flat;
  house.full_floors = size.floors - (house.top == Top::set_back ? 1 : 0);
  draw_openings(house, rng);
  draw_features(house, rng);
  return house;
}

/// Adds the sides and the back, which have fewer windows than the front.
void add_other_walls(Mesh& mesh, const TownHouse& house) {
  constexpr double kCell_m = 4.5;
  constexpr int kMaxCells = 18;
  const Block block = house.block();
  Opening window = house.window;
  window.width_m = std::min(window.width_m, 1.4);
  for (std::size_t side = 1; side < Block::kWalls; ++side) {
    const double along_m = block.length_m(side);
    const int cells = cells_of(along_m, kCell_m, std::max(1, kMaxCells / house.size.floors));
    for (int floor = 0; floor < house.full_floors; ++floor) {
      const WallPart whole = {0.0, along_m, floor * house.floor_m, (floor + 1) * house.floor_m};
      add_openings(mesh, block.wall(side), {whole, cells}, window, house.wall);
    }
  }
}

/// Adds the highest floor, away from the edges of the roof.
void add_set_back_floor(Mesh& mesh, const TownHouse& house) {
  constexpr double kIn_m = 1.5;
  const Block block = {{kIn_m, kIn_m, house.height_m()},
                       house.size.width_m - 2.0 * kIn_m,
                       house.size.depth_m - 2.0 * kIn_m};
  for (std::size_t side = 0; side < Block::kWalls; ++side) {
    const double along_m = block.length_m(side);
    const Row row = {{0.0, along_m, 0.0, house.floor_m}, cells_of(along_m, 3.5, 6)};
    add_openings(mesh, block.wall(side), row, house.window, house.wall);
  }
  add_flat_roof(mesh, block, house.floor_m, 0.3, Material::concrete);
}

void add_top(Mesh& mesh, const TownHouse& house) {
  switch (house.top) {
    case Top::flat:
      add_flat_roof(mesh, house.block(), house.height_m(), 0.6, house.wall);
      break;
    case Top::pitched:
      add_pitched_roof(mesh, house.block(), 0,
                       {house.height_m(), house.rise_m, house.cornice_m + 0.15}, house.wall);
      break;
    case Top::set_back:
      add_flat_roof(mesh, house.block(), house.height_m(), 1.0, house.wall);
      add_set_back_floor(mesh, house);
      break;
  }
}

}  // namespace

Mesh make_building(const BuildingSize& size, Rng& rng) {
  const TownHouse house = draw_town_house(size, rng);
  Mesh mesh;
  add_foundation(mesh, house.block());
  add_front(mesh, house);
  add_other_walls(mesh, house);
  add_top(mesh, house);
  return mesh;
}

}  // namespace croon::simulation

#include <algorithm>

#include "framework/simulation/objects/roofs.hpp"
#include "framework/simulation/objects/town_house.hpp"

namespace croon::simulation {
namespace {

/// The sides and the back have fewer windows than the front.
void add_other_walls(Mesh& mesh, const TownHouse& house) {
  constexpr double kCell_m = 4.5;
  constexpr int kMostCells = 18;
  const Block block = house.block();
  Opening window = house.window;
  window.width_m = std::min(window.width_m, 1.4);
  for (std::size_t side = 1; side < Block::kWalls; ++side) {
    const double along_m = block.length_m(side);
    const int cells = cells_of(along_m, kCell_m, std::max(1, kMostCells / house.size.floors));
    for (int floor = 0; floor < house.full_floors; ++floor) {
      const WallPart whole = {0.0, along_m, floor * house.floor_m, (floor + 1) * house.floor_m};
      add_openings(mesh, block.wall(side), {whole, cells}, window, house.wall);
    }
  }
}

/// The highest floor, away from the edges of the roof.
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

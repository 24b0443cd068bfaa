#include "framework/simulation/objects/town_house.hpp"

#include <algorithm>

#include "framework/simulation/draws.hpp"

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

}  // namespace

TownHouse draw_town_house(const BuildingSize& size, Rng& rng) {
  // Windows of very large fronts get wider instead of more.
  constexpr int kMostCells = 44;
  TownHouse house;
  house.size = size;
  house.wall = pick<Material>(
      {Material::brick, Material::plaster, Material::plaster, Material::concrete}, rng);
  house.floor_m = rng.uniform(2.8, 3.8);
  const double cell_m = rng.uniform(2.2, 3.5);
  house.cells = cells_of(size.width_m, cell_m, std::max(1, kMostCells / size.floors));
  house.top = pick<Top>({Top::flat, Top::flat, Top::pitched, Top::pitched, Top::set_back}, rng);
  const bool is_large = size.floors > 2 && std::min(size.width_m, size.depth_m) > 6.0;
  if (house.top == Top::set_back && !is_large) house.top = Top::flat;
  house.full_floors = size.floors - (house.top == Top::set_back ? 1 : 0);
  draw_openings(house, rng);
  draw_features(house, rng);
  return house;
}

}  // namespace croon::simulation

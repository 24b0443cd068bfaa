#include <algorithm>
#include <utility>

#include "framework/simulation/objects/town_house.hpp"

namespace croon::simulation {
namespace {

/// Adds a slab with a railing on three sides in front of the cell `part`.
void add_balcony(Mesh& mesh, const TownHouse& house, const WallPart& part) {
  constexpr double kOut_m = 1.2;
  constexpr double kSlab_m = 0.18;
  constexpr double kRailing_m = 1.0;
  const double low_m = part.low_m + 0.02;
  const WallPart slab = {part.left_m + 0.15, part.right_m - 0.15, low_m, low_m + kSlab_m};
  add_relief(mesh, house.front(), slab, kOut_m, Material::concrete);
  const WallFrame railing = house.front().before(kOut_m);
  const double top_m = slab.high_m + kRailing_m;
  add_wall(mesh, railing, {slab.left_m, slab.right_m, slab.high_m, top_m}, Material::metal);
  for (const double x_m : {slab.left_m, slab.right_m}) {
    mesh.add_quad(railing.point(x_m, slab.high_m), railing.point(x_m, slab.high_m, kOut_m),
                  railing.point(x_m, top_m, kOut_m), railing.point(x_m, top_m), Material::metal);
  }
}

/// Adds a bay on all floors except the ground floor and the highest.
void add_bay(Mesh& mesh, const TownHouse& house) {
  constexpr double kOut_m = 0.7;
  const int highest = house.full_floors - 2;
  for (int floor = 1; floor <= highest; ++floor) {
    add_opening(mesh, house.front().before(kOut_m), house.row(floor).cell(house.bay_cell),
                house.window, house.wall);
  }
  WallPart bay = house.row(1).cell(house.bay_cell);
  bay.high_m = (highest + 1) * house.floor_m;
  add_rim(mesh, house.front(), bay, -kOut_m, 0.0, house.wall);
}

void add_ground_floor(Mesh& mesh, const TownHouse& house) {
  const Row row = house.row(0);
  for (int i = 0; i < house.cells; ++i) {
    const Opening& beside = house.has_shops ? house.shop : house.window;
    add_opening(mesh, house.front(), row.cell(i), i == house.door_cell ? house.door : beside,
                house.wall);
  }
  const WallPart door = row.cell(house.door_cell);
  const double middle_m = 0.5 * (door.left_m + door.right_m);
  const double half_m = std::min(0.5 * house.door.width_m, middle_m - door.left_m) + 0.05;
  const double width_m = house.size.width_m;
  for (const auto& [left_m, right_m] :
       {std::pair{0.0, middle_m - half_m}, std::pair{middle_m + half_m, width_m}}) {
    if (right_m - left_m < 0.1) continue;
    add_relief(mesh, house.front(), {left_m, right_m, -0.5, house.plinth_m}, house.relief_m,
               Material::concrete);
  }
  if (!house.has_shops) return;
  // The name board of the shop.
  add_relief(mesh, house.front(), {0.1, width_m - 0.1, house.floor_m - 0.6, house.floor_m - 0.15},
             2.0 * house.relief_m, Material::wood);
}

void add_upper_floors(Mesh& mesh, const TownHouse& house) {
  for (int floor = 1; floor < house.full_floors; ++floor) {
    const Row row = house.row(floor);
    for (int i = 0; i < house.cells; ++i) {
      if (i == house.bay_cell && floor < house.full_floors - 1) continue;
      add_opening(mesh, house.front(), row.cell(i), house.window, house.wall);
      if (house.has_balconies && i % 2 == 1) add_balcony(mesh, house, row.cell(i));
    }
    if (!house.has_bands) continue;
    const double z_m = row.whole.low_m;
    add_relief(mesh, house.front(), {0.0, house.size.width_m, z_m - 0.1, z_m + 0.1}, house.relief_m,
               Material::concrete);
  }
}

}  // namespace

void add_front(Mesh& mesh, const TownHouse& house) {
  add_ground_floor(mesh, house);
  add_upper_floors(mesh, house);
  if (house.bay_cell >= 0) add_bay(mesh, house);
  // A cornice must stay below the slope of the roof.
  const double slope = 2.0 * house.rise_m / house.size.depth_m;
  const double below_m = house.top == Top::pitched ? slope * house.cornice_m + 0.01 : 0.0;
  const double top_m = house.height_m() - below_m;
  add_relief(mesh, house.front(), {0.0, house.size.width_m, top_m - 0.3, top_m}, house.cornice_m,
             Material::concrete);
}

}  // namespace croon::simulation

#pragma once

#include "framework/simulation/objects/buildings.hpp"
#include "framework/simulation/objects/facade.hpp"

namespace croon::simulation {

/// What is on a town house.
enum class Top { flat, pitched, set_back };

/// A drawn town house.
struct TownHouse {
  BuildingSize size;
  Material wall = Material::plaster;
  double floor_m = 3.2;
  int full_floors = 3;  ///< But a floor that is set back.
  int cells = 5;        ///< Of the front.
  int door_cell = 0;
  int bay_cell = -1;  ///< -1: the house has no bay.
  bool has_balconies = false;
  bool has_shops = false;
  bool has_bands = false;
  double plinth_m = 0.4;
  double relief_m = 0.05;  ///< How far the plinth and the bands stand out.
  double cornice_m = 0.2;  ///< How far the cornice does.
  Top top = Top::flat;
  double rise_m = 3.0;  ///< Of a pitched roof.
  Opening window;
  Opening shop;
  Opening door;

  double height_m() const { return full_floors * floor_m; }
  Block block() const { return {Eigen::Vector3d::Zero(), size.width_m, size.depth_m}; }
  WallFrame front() const { return block().wall(0); }
  /// The cells of the front's floor `floor`.
  Row row(int floor) const {
    return {{0.0, size.width_m, floor * floor_m, (floor + 1) * floor_m}, cells};
  }
};

/// A town house of `size` with all that `rng` decides.
TownHouse draw_town_house(const BuildingSize& size, Rng& rng);

/// The front of `house` from the plinth to the cornice.
void add_front(Mesh& mesh, const TownHouse& house);

}  // namespace croon::simulation

#pragma once

#include "framework/simulation/objects/facade.hpp"
#include "framework/simulation/objects/objects.hpp"

namespace croon::simulation {

/// The roof of a town house: flat, pitched, or a set-back floor with a flat roof.
enum class Top { flat, pitched, set_back };

/// The dimensions and features of a town house.
struct TownHouse {
  BuildingSize size;
  Material wall = Material::plaster;
  double floor_m = 3.2;
  int full_floors = 3;  ///< Without the set-back floor.
  int cells = 5;        ///< Of the front.
  int door_cell = 0;
  int bay_cell = -1;  ///< -1: the house has no bay.
  bool has_balconies = false;
  bool has_shops = false;
  bool has_bands = false;
  double plinth_m = 0.4;
  double relief_m = 0.05;  ///< Protrusion of the plinth and the bands.
  double cornice_m = 0.2;  ///< Protrusion of the cornice.
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

/// Adds the front of `house` from the plinth to the cornice.
void add_front(Mesh& mesh, const TownHouse& house);

}  // namespace croon::simulation

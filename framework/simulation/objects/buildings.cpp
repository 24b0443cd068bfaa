#include "framework/simulation/objects/buildings.hpp"

#include <algorithm>
#include <cmath>

#include "framework/simulation/objects/facade.hpp"
#include "framework/simulation/primitives.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kFoundation_m = 1.0;

/// What all floors of a town house share.
struct Style {
  double floor_m = 3.2;
  double cell_m = 2.8;  ///< Aimed at; a wall holds a whole number of cells.
  Openings windows;
  Openings shop;
  bool has_shops = false;
  bool has_balconies = false;
  bool has_gable = false;
};

Style draw_style(Rng& rng) {
  constexpr std::array<Material, 3> kWalls = {Material::brick, Material::plaster,
                                              Material::concrete};
  Style style;
  style.floor_m = rng.uniform(2.8, 3.8);
  style.cell_m = rng.uniform(2.2, 3.6);
  style.windows.wall = kWalls[rng.below(kWalls.size())];
  style.windows.width_m = rng.uniform(0.9, 1.7);
  style.windows.height_m = rng.uniform(1.2, 1.8);
  style.windows.sill_m = rng.uniform(0.7, 1.0);
  style.windows.recess_m = rng.uniform(0.1, 0.3);
  style.shop = style.windows;
  style.shop.width_m = 0.85 * style.cell_m;
  style.shop.sill_m = rng.uniform(0.2, 0.5);
  style.shop.height_m = 2.2;
  style.has_shops = rng.uniform() < 0.35;
  style.has_balconies = rng.uniform() < 0.3;
  style.has_gable = rng.uniform() < 0.35;
  return style;
}

int cells_of(double width_m, const Style& style) {
  return std::max(1, static_cast<int>(std::floor(width_m / style.cell_m)));
}

/// A slab with a railing before the cell `part`.
void add_balcony(Mesh& mesh, const WallFrame& wall, const WallPart& part) {
  constexpr double kOut_m = 1.2;
  constexpr double kSlab_m = 0.18;
  constexpr double kRailing_m = 1.0;
  const WallPart slab = {part.left_m + 0.2, part.right_m - 0.2, part.low_m, part.low_m + kSlab_m};
  add_relief(mesh, wall, slab, kOut_m, Material::concrete);
  const WallFrame front = {wall.point(0.0, 0.0, -kOut_m), wall.along, wall.inwards};
  add_relief(mesh, front, {slab.left_m, slab.right_m, slab.high_m, slab.high_m + kRailing_m}, -0.04,
             Material::metal);
}

/// All floors of one wall of `width_m`; only the front has shops, balconies and a door.
void add_facade(Mesh& mesh, const WallFrame& wall, double width_m, int floors, const Style& style,
                bool is_front, std::uint64_t door) {
  const int cells = cells_of(width_m, style);
  const double cell_m = width_m / cells;
  for (int floor = 0; floor < floors; ++floor) {
    for (int i = 0; i < cells; ++i) {
      const WallPart part = {i * cell_m, (i + 1) * cell_m, floor * style.floor_m,
                             (floor + 1) * style.floor_m};
      const bool is_ground = floor == 0;
      if (is_front && is_ground && static_cast<std::uint64_t>(i) == door) {
        Openings entrance = style.windows;
        entrance.width_m = 1.3;
        entrance.sill_m = 0.0;
        entrance.height_m = 2.3;
        entrance.recess_m = 0.5;
        entrance.pane = Material::wood;
        add_opening(mesh, wall, part, entrance);
      } else {
        add_opening(mesh, wall, part,
                    is_front && is_ground && style.has_shops ? style.shop : style.windows);
      }
      if (is_front && !is_ground && style.has_balconies && i % 2 == 1) {
        add_balcony(mesh, wall, part);
      }
    }
  }
  add_wall(mesh, wall, {0.0, width_m, -kFoundation_m, 0.0}, style.windows.wall);
}

/// A plain wall, for the sides that hardly anybody sees.
void add_plain_side(Mesh& mesh, const WallFrame& wall, double width_m, double height_m,
                    const Style& style) {
  add_wall(mesh, wall, {0.0, width_m, -kFoundation_m, height_m}, style.windows.wall);
}

/// A pitched roof over the block, its ridge along x, with gables of `wall`.
void add_pitched_roof(Mesh& mesh, double width_m, double depth_m, double height_m, double rise_m,
                      double overhang_m, Material wall) {
  const double slope = rise_m / (0.5 * depth_m);
  const double eaves_m = height_m - slope * overhang_m;
  const double ridge_m = height_m + rise_m;
  const double left = -overhang_m;
  const double right = width_m + overhang_m;
  mesh.add_quad({left, -overhang_m, eaves_m}, {right, -overhang_m, eaves_m},
                {right, 0.5 * depth_m, ridge_m}, {left, 0.5 * depth_m, ridge_m}, Material::brick);
  mesh.add_quad({left, depth_m + overhang_m, eaves_m}, {right, depth_m + overhang_m, eaves_m},
                {right, 0.5 * depth_m, ridge_m}, {left, 0.5 * depth_m, ridge_m}, Material::brick);
  for (const double x : {0.0, width_m}) {
    const std::uint32_t first = mesh.add_vertex({x, 0.0, height_m});
    mesh.add_vertex({x, depth_m, height_m});
    mesh.add_vertex({x, 0.5 * depth_m, ridge_m});
    mesh.add_triangle(first, first + 1, first + 2, wall);
  }
}

void add_flat_roof(Mesh& mesh, double width_m, double depth_m, double height_m) {
  constexpr double kParapet_m = 0.6;
  add_box(mesh, {-0.25, -0.25, height_m}, {width_m + 0.25, depth_m + 0.25, height_m + kParapet_m},
          Material::concrete);
}

}  // namespace

Mesh make_building(const BuildingSize& size, Rng& rng) {
  const Style style = draw_style(rng);
  const std::uint64_t door = rng.below(static_cast<std::uint64_t>(cells_of(size.width_m, style)));
  const double rise_m = rng.uniform(2.0, 4.0);
  const double height_m = size.floors * style.floor_m;
  const std::array<WallFrame, 4> walls = walls_of(size.width_m, size.depth_m);
  Mesh mesh;
  add_facade(mesh, walls[0], size.width_m, size.floors, style, true, door);
  add_facade(mesh, walls[1], size.depth_m, size.floors, style, false, 0);
  add_plain_side(mesh, walls[2], size.width_m, height_m, style);
  add_facade(mesh, walls[3], size.depth_m, size.floors, style, false, 0);
  // The plinth and the cornice stand out a little.
  add_relief(mesh, walls[0], {0.0, size.width_m, -0.3, 0.18}, 0.05, Material::concrete);
  add_relief(mesh, walls[0], {0.0, size.width_m, height_m - 0.3, height_m}, 0.25,
             Material::concrete);
  if (style.has_gable) {
    add_pitched_roof(mesh, size.width_m, size.depth_m, height_m, rise_m, 0.4, style.windows.wall);
  } else {
    add_flat_roof(mesh, size.width_m, size.depth_m, height_m);
  }
  return mesh;
}

Mesh make_house(Rng& rng) {
  Style style = draw_style(rng);
  style.has_shops = false;
  style.has_balconies = false;
  const double width_m = rng.uniform(8.0, 14.0);
  const double depth_m = rng.uniform(7.0, 10.0);
  const double rise_m = rng.uniform(2.0, 4.0);
  const double garage_m = rng.uniform(2.8, 3.6);
  const bool has_garage = rng.uniform() < 0.5;
  const int floors = rng.uniform() < 0.5 ? 1 : 2;
  const std::uint64_t door = rng.below(static_cast<std::uint64_t>(cells_of(width_m, style)));
  const double height_m = floors * style.floor_m;
  const std::array<WallFrame, 4> walls = walls_of(width_m, depth_m);
  Mesh mesh;
  add_facade(mesh, walls[0], width_m, floors, style, true, door);
  add_facade(mesh, walls[1], depth_m, floors, style, false, 0);
  add_plain_side(mesh, walls[2], width_m, height_m, style);
  add_facade(mesh, walls[3], depth_m, floors, style, false, 0);
  add_pitched_roof(mesh, width_m, depth_m, height_m, rise_m, 0.5, style.windows.wall);
  add_box(mesh, {0.7 * width_m, 0.45 * depth_m, height_m},
          {0.7 * width_m + 0.7, 0.45 * depth_m + 0.7, height_m + rise_m + 0.8}, Material::brick);
  if (has_garage) {
    add_box(mesh, {width_m, 1.0, -kFoundation_m}, {width_m + garage_m, 7.0, 2.6},
            style.windows.wall);
    add_box(mesh, {width_m + 0.3, 0.95, 0.0}, {width_m + garage_m - 0.3, 1.0, 2.1},
            Material::metal);
  }
  return mesh;
}

Mesh make_hall(const BuildingSize& size, Rng& rng) {
  const double bay_m = rng.uniform(4.0, 7.0);
  const double floor_m = rng.uniform(3.5, 4.5);
  const bool is_metal = rng.uniform() < 0.5;
  const Material wall = is_metal ? Material::metal : Material::concrete;
  const double height_m = size.floors * floor_m;
  const int bays = std::max(1, static_cast<int>(std::floor(size.width_m / bay_m)));
  const double width_m = size.width_m / bays;
  const std::array<WallFrame, 4> walls = walls_of(size.width_m, size.depth_m);
  Mesh mesh;
  for (std::size_t side = 0; side < walls.size(); ++side) {
    const double along_m = side % 2 == 0 ? size.width_m : size.depth_m;
    add_wall(mesh, walls[side], {0.0, along_m, -kFoundation_m, height_m}, wall);
  }
  for (int i = 0; i < bays; ++i) {
    const double left_m = i * width_m;
    add_relief(mesh, walls[0], {left_m, left_m + 0.35, 0.0, height_m}, 0.2, wall);
    if (rng.uniform() < 0.4) {
      add_relief(mesh, walls[0], {left_m + 0.8, left_m + width_m - 0.5, 0.0, 3.0}, 0.08,
                 Material::metal);
    }
  }
  add_flat_roof(mesh, size.width_m, size.depth_m, height_m);
  return mesh;
}

}  // namespace croon::simulation

#include <algorithm>

#include "framework/simulation/objects/facade.hpp"
#include "framework/simulation/objects/objects.hpp"

namespace croon::simulation {
namespace {

/// The common style of all walls of a hall.
struct HallStyle {
  Material wall = Material::metal;
  double height_m = 8.0;
  double bay_m = 6.0;  ///< Distance from one rib to the next.
  bool has_ribs = false;
  double rib_m = 0.2;      ///< Protrusion of the ribs.
  double gates = 0.3;      ///< Share of the front's bays that have a gate.
  bool has_lights = true;  ///< A row of windows high up.
};

HallStyle draw_style(int floors, Rng& rng) {
  HallStyle style;
  style.wall = pick<Material>(
      {Material::metal, Material::concrete, Material::plaster, Material::white_paint}, rng);
  style.height_m = floors * rng.uniform(3.5, 4.5);
  style.bay_m = rng.uniform(4.5, 7.0);
  style.has_ribs = chance(rng, 0.6);
  style.rib_m = rng.uniform(0.1, 0.3);
  style.gates = rng.uniform(0.1, 0.5);
  style.has_lights = chance(rng, 0.5);
  return style;
}

/// Adds the bays of the front: plain, with a gate, or with a window high up.
void add_front(Mesh& mesh, const WallFrame& wall, const Row& row, const HallStyle& style,
               Rng& rng) {
  const double bay_m = row.whole.right_m / row.cells;
  const Opening gate = {0.7 * bay_m, 0.0, std::min(4.2, 0.65 * style.height_m), 0.3,
                        Material::metal};
  const Opening light = {0.8 * bay_m, style.height_m - 1.8, 1.0, 0.15, Material::glass};
  for (int i = 0; i < row.cells; ++i) {
    if (chance(rng, style.gates)) {
      add_opening(mesh, wall, row.cell(i), gate, style.wall);
    } else if (style.has_lights) {
      add_opening(mesh, wall, row.cell(i), light, style.wall);
    } else {
      add_wall(mesh, wall, row.cell(i), style.wall);
    }
  }
}

/// Adds ribs between the bays of `row` and at both ends.
void add_ribs(Mesh& mesh, const WallFrame& wall, const Row& row, const HallStyle& style) {
  constexpr double kWide_m = 0.35;
  for (int i = 0; i <= row.cells; ++i) {
    const double share = static_cast<double>(i) / row.cells;
    const double left_m = share * (row.whole.right_m - kWide_m);
    add_relief(mesh, wall, {left_m, left_m + kWide_m, -0.5, style.height_m}, style.rib_m,
               style.wall);
  }
}

}  // namespace

Mesh make_hall(const BuildingSize& size, Rng& rng) {
  constexpr int kMaxBays = 8;
  const HallStyle style = draw_style(size.floors, rng);
  const Block block = {Eigen::Vector3d::Zero(), size.width_m, size.depth_m};
  Mesh mesh;
  add_foundation(mesh, block);
  for (std::size_t side = 0; side < Block::kWalls; ++side) {
    const double along_m = block.length_m(side);
    const Row row = {{0.0, along_m, 0.0, style.height_m}, cells_of(along_m, style.bay_m, kMaxBays)};
    if (side == 0) {
      add_front(mesh, block.wall(side), row, style, rng);
    } else {
      add_wall(mesh, block.wall(side), row.whole, style.wall);
    }
    if (style.has_ribs) add_ribs(mesh, block.wall(side), row, style);
  }
  add_flat_roof(mesh, block, style.height_m, 0.5, style.wall);
  return mesh;
}

}  // namespace croon::simulation

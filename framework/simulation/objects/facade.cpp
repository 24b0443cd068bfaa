#include "framework/simulation/objects/facade.hpp"

#include <algorithm>
#include <array>

#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// The hole for `opening` in `part`, at least 8 cm from the sides and the top of `part`.
WallPart hole_of(const WallPart& part, const Opening& opening) {
  constexpr double kEdge_m = 0.08;
  const double middle_m = 0.5 * (part.left_m + part.right_m);
  const double half_m =
      std::min(0.5 * opening.width_m, 0.5 * (part.right_m - part.left_m) - kEdge_m);
  const double low_m = part.low_m + opening.sill_m;
  const double high_m = std::min(low_m + opening.height_m, part.high_m - kEdge_m);
  return {middle_m - half_m, middle_m + half_m, low_m, high_m};
}

}  // namespace

WallFrame Block::wall(std::size_t side) const {
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const std::array<WallFrame, kWalls> walls = {{{corner, x, y},
                                                {corner + width_m * x, y, -x},
                                                {corner + width_m * x + depth_m * y, -x, -y},
                                                {corner + depth_m * y, -y, x}}};
  return walls[side];
}

WallPart Row::cell(int index) const {
  const double cell_m = (whole.right_m - whole.left_m) / cells;
  // Neighbouring cells share an edge exactly, and the last edge is the end of the wall.
  const auto edge_m = [&](int i) { return i == cells ? whole.right_m : whole.left_m + i * cell_m; };
  return {edge_m(index), edge_m(index + 1), whole.low_m, whole.high_m};
}

int cells_of(double width_m, double cell_m, int most) {
  return std::clamp(static_cast<int>(width_m / cell_m), 1, most);
}

void add_wall(Mesh& mesh, const WallFrame& frame, const WallPart& part, Material material) {
  mesh.add_quad(frame.point(part.left_m, part.low_m), frame.point(part.right_m, part.low_m),
                frame.point(part.right_m, part.high_m), frame.point(part.left_m, part.high_m),
                material);
}

void add_rim(Mesh& mesh, const WallFrame& frame, const WallPart& part, double from_depth_m,
             double to_depth_m, Material material) {
  const std::array<double, 4> x = {part.left_m, part.right_m, part.right_m, part.left_m};
  const std::array<double, 4> z = {part.low_m, part.low_m, part.high_m, part.high_m};
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    mesh.add_quad(
        frame.point(x[i], z[i], from_depth_m), frame.point(x[next], z[next], from_depth_m),
        frame.point(x[next], z[next], to_depth_m), frame.point(x[i], z[i], to_depth_m), material);
  }
}

void add_relief(Mesh& mesh, const WallFrame& frame, const WallPart& part, double out_m,
                Material material) {
  add_wall(mesh, frame.before(out_m), part, material);
  add_rim(mesh, frame, part, -out_m, 0.0, material);
}

void add_opening(Mesh& mesh, const WallFrame& frame, const WallPart& part, const Opening& opening,
                 Material wall) {
  const WallPart hole = hole_of(part, opening);
  add_wall(mesh, frame, {part.left_m, hole.left_m, part.low_m, part.high_m}, wall);
  add_wall(mesh, frame, {hole.right_m, part.right_m, part.low_m, part.high_m}, wall);
  add_wall(mesh, frame, {hole.left_m, hole.right_m, hole.high_m, part.high_m}, wall);
  if (opening.sill_m > 0.0) {
    add_wall(mesh, frame, {hole.left_m, hole.right_m, part.low_m, hole.low_m}, wall);
  }
  add_rim(mesh, frame, hole, 0.0, opening.recess_m, wall);
  add_wall(mesh, frame.before(-opening.recess_m), hole, opening.pane);
}

void add_openings(Mesh& mesh, const WallFrame& frame, const Row& row, const Opening& opening,
                  Material wall) {
  for (int i = 0; i < row.cells; ++i) add_opening(mesh, frame, row.cell(i), opening, wall);
}

void add_foundation(Mesh& mesh, const Block& block) {
  constexpr double kDepth_m = 1.0;
  for (std::size_t side = 0; side < Block::kWalls; ++side) {
    add_wall(mesh, block.wall(side), {0.0, block.length_m(side), -kDepth_m, 0.0},
             Material::concrete);
  }
}

void add_pitched_roof(Mesh& mesh, const Block& block, std::size_t side, const PitchedRoof& roof,
                      Material gable) {
  const WallFrame eaves = block.wall(side);
  const double width_m = block.length_m(side);
  const double depth_m = block.length_m(side + 1);
  const double middle_m = 0.5 * depth_m;
  const double ridge_m = roof.height_m + roof.rise_m;
  const double low_m = roof.height_m - roof.eaves_m * roof.rise_m / middle_m;
  const double left_m = -roof.verges_m;
  const double right_m = width_m + roof.verges_m;
  for (const double eaves_m : {-roof.eaves_m, depth_m + roof.eaves_m}) {
    mesh.add_quad(eaves.point(left_m, low_m, eaves_m), eaves.point(right_m, low_m, eaves_m),
                  eaves.point(right_m, ridge_m, middle_m), eaves.point(left_m, ridge_m, middle_m),
                  roof.tiles);
  }
  for (const double x_m : {0.0, width_m}) {
    const std::uint32_t first = mesh.add_vertex(eaves.point(x_m, roof.height_m, 0.0));
    mesh.add_vertex(eaves.point(x_m, roof.height_m, depth_m));
    mesh.add_vertex(eaves.point(x_m, ridge_m, middle_m));
    mesh.add_triangle(first, first + 1, first + 2, gable);
  }
}

void add_flat_roof(Mesh& mesh, const Block& block, double height_m, double parapet_m,
                   Material parapet) {
  constexpr double kThick_m = 0.25;
  const Vector3d corner = block.corner + height_m * Vector3d::UnitZ();
  const double width_m = block.width_m;
  const double depth_m = block.depth_m;
  mesh.add_quad(corner, corner + Vector3d(width_m, 0.0, 0.0),
                corner + Vector3d(width_m, depth_m, 0.0), corner + Vector3d(0.0, depth_m, 0.0),
                Material::concrete);
  for (const double x_m : {0.0, width_m - kThick_m}) {
    add_box(mesh, corner + Vector3d(x_m, kThick_m, 0.0),
            corner + Vector3d(x_m + kThick_m, depth_m - kThick_m, parapet_m), parapet);
  }
  for (const double y_m : {0.0, depth_m - kThick_m}) {
    add_box(mesh, corner + Vector3d(0.0, y_m, 0.0),
            corner + Vector3d(width_m, y_m + kThick_m, parapet_m), parapet);
  }
}

}  // namespace croon::simulation

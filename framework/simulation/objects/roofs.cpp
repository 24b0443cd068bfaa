#include "framework/simulation/objects/roofs.hpp"

#include "framework/simulation/primitives.hpp"

namespace croon::simulation {

using Eigen::Vector3d;

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

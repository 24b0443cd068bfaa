#pragma once

#include <Eigen/Core>
#include <array>

#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// Where a wall stands: `origin` at its lower left, seen from outside; `along` and `inwards` are
/// level and of length 1.
struct WallFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Vector3d inwards = Eigen::Vector3d::UnitY();

  /// The place `x_m` along, `z_m` up and `depth_m` inside of the wall's plane.
  Eigen::Vector3d point(double x_m, double z_m, double depth_m = 0.0) const {
    return origin + x_m * along + z_m * Eigen::Vector3d::UnitZ() + depth_m * inwards;
  }
};

/// A rectangle of a wall.
struct WallPart {
  double left_m = 0.0;
  double right_m = 0.0;
  double low_m = 0.0;
  double high_m = 0.0;
};

/// The openings of a wall, one in the middle of each cell of a grid.
struct Openings {
  double width_m = 1.2;
  double sill_m = 0.9;    ///< From the floor to the opening.
  double height_m = 1.4;  ///< Of the opening.
  double recess_m = 0.2;  ///< How deep the pane lies.
  Material wall = Material::plaster;
  Material pane = Material::glass;
};

/// The plain wall over `part`.
void add_wall(Mesh& mesh, const WallFrame& frame, const WallPart& part, Material material);

/// The wall over `part` with one opening in the middle: frame, reveals and pane.
void add_opening(Mesh& mesh, const WallFrame& frame, const WallPart& part,
                 const Openings& openings);

/// A box that stands out of the wall over `part` by `out_m`.
void add_relief(Mesh& mesh, const WallFrame& frame, const WallPart& part, double out_m,
                Material material);

/// The four walls of the block from (0, 0) to (width, depth), front first, then right, back, left.
std::array<WallFrame, 4> walls_of(double width_m, double depth_m);

}  // namespace croon::simulation

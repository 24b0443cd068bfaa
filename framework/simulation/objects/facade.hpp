#pragma once

#include <Eigen/Core>
#include <cstddef>

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
  /// The frame of a wall before this one.
  WallFrame before(double out_m) const { return {point(0.0, 0.0, -out_m), along, inwards}; }
};

/// A rectangle of a wall.
struct WallPart {
  double left_m = 0.0;
  double right_m = 0.0;
  double low_m = 0.0;
  double high_m = 0.0;
};

/// A box with four walls: 0 the front, which looks towards -y, 1 the right one, 2 the back, 3 the
/// left one.
struct Block {
  Eigen::Vector3d corner = Eigen::Vector3d::Zero();  ///< Left end of the front, at its foot.
  double width_m = 10.0;
  double depth_m = 10.0;

  static constexpr std::size_t kWalls = 4;
  WallFrame wall(std::size_t side) const;
  double length_m(std::size_t side) const { return side % 2 == 0 ? width_m : depth_m; }
};

/// A window, a door or a gate in a recess.
struct Opening {
  double width_m = 1.2;
  double sill_m = 0.9;    ///< From the floor to the opening.
  double height_m = 1.4;  ///< Of the opening.
  double recess_m = 0.2;  ///< How deep the pane lies.
  Material pane = Material::glass;
};

/// Openings side by side, one in the middle of each of `cells` equal parts of `whole`.
struct Row {
  WallPart whole;
  int cells = 1;

  /// The part of the cell `index`.
  WallPart cell(int index) const;
};

/// The number of cells of about `cell_m`, 1 to `most`, that `width_m` holds.
int cells_of(double width_m, double cell_m, int most);

/// The plain wall over `part`.
void add_wall(Mesh& mesh, const WallFrame& frame, const WallPart& part, Material material);

/// The four faces around `part` between two depths: the reveals of an opening, the edges of a slab.
void add_rim(Mesh& mesh, const WallFrame& frame, const WallPart& part, double from_depth_m,
             double to_depth_m, Material material);

/// A box that stands out of the wall over `part` by `out_m`.
void add_relief(Mesh& mesh, const WallFrame& frame, const WallPart& part, double out_m,
                Material material);

/// The wall over `part` with `opening` in its middle, made smaller where it would not fit.
void add_opening(Mesh& mesh, const WallFrame& frame, const WallPart& part, const Opening& opening,
                 Material wall);

/// The same over every cell of `row`.
void add_openings(Mesh& mesh, const WallFrame& frame, const Row& row, const Opening& opening,
                  Material wall);

/// The walls below the ground floor of `block`, 1 m deep.
void add_foundation(Mesh& mesh, const Block& block);

}  // namespace croon::simulation

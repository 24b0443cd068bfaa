#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// The frame of a wall: `origin` at the lower left, seen from outside; `along` and `inwards` are
/// horizontal unit vectors.
struct WallFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  Eigen::Vector3d inwards = Eigen::Vector3d::UnitY();

  /// The point `x_m` along the wall, `z_m` up and `depth_m` behind its plane.
  Eigen::Vector3d point(double x_m, double z_m, double depth_m = 0.0) const {
    return origin + x_m * along + z_m * Eigen::Vector3d::UnitZ() + depth_m * inwards;
  }
  /// The frame of a wall `out_m` in front of this one.
  WallFrame before(double out_m) const { return {point(0.0, 0.0, -out_m), along, inwards}; }
};

/// A rectangle of a wall.
struct WallPart {
  double left_m = 0.0;
  double right_m = 0.0;
  double low_m = 0.0;
  double high_m = 0.0;
};

/// A box with four walls: 0 is the front, which faces -y, 1 the right side, 2 the back, 3 the left
/// side.
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
  double sill_m = 0.9;  ///< From the floor to the opening.
  double height_m = 1.4;
  double recess_m = 0.2;  ///< Depth of the pane behind the wall.
  Material pane = Material::glass;
};

/// A part of a wall, divided into `cells` equal parts side by side.
struct Row {
  WallPart whole;
  int cells = 1;

  /// The part of the cell `index`.
  WallPart cell(int index) const;
};

/// The number of cells of at least `cell_m` that fit into `width_m`, from 1 to `most`.
int cells_of(double width_m, double cell_m, int most);

/// Adds a plain wall.
void add_wall(Mesh& mesh, const WallFrame& frame, const WallPart& part, Material material);

/// Adds the four faces around `part` between two depths: the reveals of an opening or the edges of
/// a slab.
void add_rim(Mesh& mesh, const WallFrame& frame, const WallPart& part, double from_depth_m,
             double to_depth_m, Material material);

/// Adds a box that protrudes from the wall by `out_m`.
void add_relief(Mesh& mesh, const WallFrame& frame, const WallPart& part, double out_m,
                Material material);

/// Adds a wall with `opening` in its middle. The opening becomes smaller if it does not fit.
void add_opening(Mesh& mesh, const WallFrame& frame, const WallPart& part, const Opening& opening,
                 Material wall);

/// The same in every cell of `row`.
void add_openings(Mesh& mesh, const WallFrame& frame, const Row& row, const Opening& opening,
                  Material wall);

/// Adds the walls below the ground floor of `block`, 1 m deep.
void add_foundation(Mesh& mesh, const Block& block);

/// A pitched roof with two slopes over a block.
struct PitchedRoof {
  double height_m = 6.0;  ///< Height at which the slopes meet the walls.
  double rise_m = 3.0;    ///< Height from there to the ridge.
  double eaves_m = 0.4;   ///< Overhang over the walls below the slopes.
  double verges_m = 0.0;  ///< Overhang over the gables.
  Material tiles = Material::brick;
};

/// Adds `roof` with its gables to `block`. The wall `side` and the opposite one are below its
/// slopes.
void add_pitched_roof(Mesh& mesh, const Block& block, std::size_t side, const PitchedRoof& roof,
                      Material gable);

/// Adds a flat roof `height_m` above the foot of `block`, with a parapet of `parapet_m` above the
/// walls.
void add_flat_roof(Mesh& mesh, const Block& block, double height_m, double parapet_m,
                   Material parapet);

}  // namespace croon::simulation

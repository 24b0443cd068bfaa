#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "framework/simulation/draws.hpp"
#include "framework/simulation/road_shape.hpp"

namespace croon::simulation {

/// The pose of an object in road coordinates.
struct RoadPose {
  double s_m = 0.0;
  double d_m = 0.0;
  double yaw_rad = 0.0;  ///< From the direction of the road at s.
};

/// A box in road coordinates: s, d and the height above the ground.
using RoadBox = Eigen::AlignedBox3d;

/// The box over `along_m` (s) and `across_m` (d), from the ground to `height_m`.
RoadBox road_box(const Span& along_m, const Span& across_m, double height_m);

/// The height at which objects are divided: crowns, arms and roofs above it are no obstacle.
constexpr double kHeadroom_m = 3.0;

/// The boxes that `mesh` (in its own frame) requires at `pose` on a road with `curvature_per_m`:
/// one for the part below the headroom and one for the part above it. A part without vertices has
/// an empty box.
std::array<RoadBox, 2> boxes_of(const Mesh& mesh, const RoadPose& pose, double curvature_per_m);

/// The occupied space of a scene.
class Occupancy {
 public:
  /// Whether `box` overlaps no occupied box; boxes may touch.
  bool is_free(const RoadBox& box) const;
  void occupy(const RoadBox& box) { taken_.push_back(box); }

 private:
  std::vector<RoadBox> taken_;
};

/// One side of a road in its own coordinates: `along_m` along the road (s of the scene's road, d
/// for the crossing road) and `out_m` away from its centre line.
struct Roadside {
  double sign = 1.0;  ///< 1: left of the scene's road, or ahead of the crossing road; otherwise -1.
  bool is_across = false;     ///< Whether it is a side of the crossing road.
  double crossing_s_m = 0.0;  ///< s of the crossing road's centre line.

  /// The pose of an object whose x axis runs along the road and whose y axis points away from it,
  /// before it is turned by `turn_rad`.
  RoadPose at(double along_m, double out_m, double turn_rad = 0.0) const;
  /// The box over a piece of the side.
  RoadBox box(const Span& along_m, const Span& out_m, double height_m) const;
  /// The length along the side that an object of `length_m` between the distances `out_m` requires.
  double along_of(const RoadShape& shape, double length_m, const Span& out_m) const;
};

/// Rotations for Roadside::at: the x axis points to the road, or in the driving direction of this
/// side.
constexpr double kToRoad_rad = -1.5707963267948966;
constexpr double kWithTraffic_rad = 3.141592653589793;

/// Both sides of the scene's road, left first.
std::array<Roadside, 2> both_sides();

}  // namespace croon::simulation

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// Where an object stands, in road coordinates.
struct Place {
  double s_m = 0.0;
  double d_m = 0.0;
  double yaw_rad = 0.0;  ///< From the road's direction there.
};

/// From one length to another, metres.
struct Interval {
  double from_m = 0.0;
  double to_m = 0.0;

  double length_m() const { return to_m - from_m; }
  double middle_m() const { return 0.5 * (from_m + to_m); }
  bool holds(double value_m) const { return value_m >= from_m && value_m < to_m; }
};

/// A box in road coordinates: s, d and the height above the ground.
using RoadBox = Eigen::AlignedBox3d;

/// The box over `along_m` (s) and `across_m` (d), from the ground to `height_m`.
RoadBox road_box(const Interval& along_m, const Interval& across_m, double height_m);

/// How much longer in s a thing is than in metres where a road with `curvature_per_m` bends, at the
/// worst between the two d of `across_m`.
double bend_ratio(double curvature_per_m, const Interval& across_m);

/// Height at which objects are cut in two: below it crowns, arms and roofs are out of the way.
constexpr double kHeadroom_m = 3.0;

/// The boxes that `mesh` (its own frame) needs at `place` of a road with `curvature_per_m`: of what
/// is below the headroom and of what is above it. Empty boxes where there is nothing.
std::array<RoadBox, 2> boxes_of(const Mesh& mesh, const Place& place, double curvature_per_m);

/// Which space of a scene is taken.
class Occupancy {
 public:
  bool is_free(const RoadBox& box) const;
  void take(const RoadBox& box) { taken_.push_back(box); }

 private:
  std::vector<RoadBox> taken_;
};

}  // namespace croon::simulation

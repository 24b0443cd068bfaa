#pragma once

#include <Eigen/Core>

#include "framework/base/rng.hpp"
#include "framework/simulation/road_shape.hpp"

namespace croon::simulation {

/// The ground of a scene: the surface of a road and its surroundings. World frame: origin on the
/// road's centre line beside the car, x along the road there, y left, z up.
class Ground {
 public:
  /// `key` determines the roughness.
  Ground(const RoadShape& shape, const StreamKey& key) : shape_(shape), key_(key) {}

  const RoadShape& shape() const { return shape_; }

  /// World coordinates of the point `above_m` vertically above the surface.
  Eigen::Vector3d point(double s_m, double d_m, double above_m = 0.0) const;
  /// Yaw of the road's direction at s in the world frame, radians.
  double heading_rad(double s_m) const { return shape_.curvature_per_m * s_m; }
  /// `T_world_object` of an upright object on the ground, turned by `yaw_rad` from the road's
  /// direction.
  RigidTransform upright(double s_m, double d_m, double yaw_rad) const;
  /// The same for an object that leans with the slope, as a car does.
  RigidTransform on_slope(double s_m, double d_m, double yaw_rad) const;

  /// Adds the surface to `mesh`.
  void add_to(Mesh& mesh) const;

 private:
  double roughness_m(double s_m, double d_m) const;

  RoadShape shape_;
  StreamKey key_;
};

}  // namespace croon::simulation

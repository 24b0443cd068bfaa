#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "framework/base/rng.hpp"
#include "framework/simulation/mesh.hpp"

namespace croon::simulation {

/// A painted line along the road.
struct LaneLine {
  double d_m = 0.0;  ///< Where it runs, left of the centre line.
  bool is_dashed = false;
};

/// A second road across the first.
struct Crossing {
  double s_m = 0.0;           ///< Where its centre line cuts the first one's.
  double half_width_m = 4.0;  ///< Of its carriageway.
};

/// The road that a scene is built along, in road coordinates: `s_m` along its centre line (the car
/// stands at 0 and drives towards larger s), `d_m` to the left of it.
struct RoadShape {
  double curvature_per_m = 0.0;   ///< Of the centre line, left turns positive; |d| < 1 / curvature.
  double half_width_m = 4.0;      ///< Of the carriageway, kerb to kerb.
  double grade = 0.0;             ///< Slope along the road.
  double banking = 0.0;           ///< Slope across it, rising to the left.
  double crown = 0.0;             ///< Slope from the centre line down to either side.
  double roughness_m = 0.003;     ///< Standard deviation of the surface from the ideal one.
  double kerb_height_m = 0.12;    ///< 0: the ground goes on level.
  double pavement_width_m = 3.0;  ///< Behind the kerb.
  Material behind = Material::grass;  ///< What is behind the pavement.
  double behind_roughness_m = 0.02;   ///< Standard deviation there.
  std::vector<LaneLine> lines;
  std::optional<Crossing> crossing;
};

/// The ground of a scene: a surface over the (s, d) plane, 250 m along the road each way and 120 m
/// across it, less where the road's curve is tighter. World frame: origin on the road's centre line
/// beside the car, x along the road there, y left, z up.
class Ground {
 public:
  Ground(const RoadShape& shape, const StreamKey& key);

  const RoadShape& shape() const { return shape_; }

  /// Height of the ideal surface without roughness, kerbs included.
  double height_m(double s_m, double d_m) const;
  /// World coordinates of the point `above_m` over the surface; vertical is vertical, whatever the
  /// road's slopes.
  Eigen::Vector3d point(double s_m, double d_m, double above_m = 0.0) const;
  /// Direction of the road at s: yaw of its tangent in the world, radians.
  double heading_rad(double s_m) const;
  /// `T_world_object` of an upright object on the ground, turned by `yaw_rad` from the road's
  /// direction.
  RigidTransform upright(double s_m, double d_m, double yaw_rad) const;
  /// The same for an object that stands on the slope, as a car does.
  RigidTransform on_slope(double s_m, double d_m, double yaw_rad) const;

  /// Adds the surface.
  void add_to(Mesh& mesh) const;

 private:
  double roughness_at(double s_m, double d_m) const;

  RoadShape shape_;
  StreamKey key_;
};

}  // namespace croon::simulation

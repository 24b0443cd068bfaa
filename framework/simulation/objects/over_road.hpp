#pragma once

#include "framework/simulation/ground.hpp"
#include "framework/simulation/objects/along_path.hpp"

namespace croon::simulation {

/// What structures over a road are measured from: level across the road, at the height of the
/// carriageway's highest point there.
class OverRoad {
 public:
  explicit OverRoad(const Ground& ground) : ground_(ground) {}

  /// World coordinates `d_m` left of the centre line and `above_m` over the carriageway; below 0,
  /// that far below the ground there instead, so that feet of walls are hidden.
  Eigen::Vector3d point(double s_m, double d_m, double above_m) const;
  /// The corners (d, above) of `profile` at each of `places`.
  std::vector<Ring> rings(const std::vector<double>& places, const Profile& profile) const;

 private:
  const Ground& ground_;
};

/// Evenly spaced places from `from_m` to `to_m`, both among them, 5 m or less apart.
std::vector<double> places_between(double from_m, double to_m);

}  // namespace croon::simulation

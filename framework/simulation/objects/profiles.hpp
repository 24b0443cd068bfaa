#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/simulation/objects/objects.hpp"
#include "framework/simulation/objects/shapes.hpp"

namespace croon::simulation {

/// An outline across a line: (to the left of the line, above it), metres.
using Profile = std::vector<Eigen::Vector2d>;

/// The outline of a box between two corners.
Profile box_profile(const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// `profile` across `path` at each point of the path, with mitred corners: the thickness is the
/// same in each piece.
std::vector<Ring> rings_along(const Path& path, const Profile& profile);

/// A point on a path and the horizontal unit vector along the path there.
struct PathPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();

  /// The level direction to the left of the path.
  Eigen::Vector3d left() const { return {-along.y(), along.x(), 0.0}; }
};

/// Evenly spaced points on the path from its start to its end, at most `step_m` apart.
std::vector<PathPoint> points_along(const Path& path, double step_m);

/// Adds an upright box around `point`, from `low_m` to `high_m` above it; `half_m` are half its
/// lengths along and across the path.
void add_pillar(Mesh& mesh, const PathPoint& point, const Eigen::Vector2d& half_m, double low_m,
                double high_m, Material material);

/// The frame of structures over a road: level across the road, at the height of the carriageway's
/// highest point across it.
class OverRoad {
 public:
  explicit OverRoad(const Ground& ground) : ground_(ground) {}

  /// World coordinates of the point `d_m` left of the centre line and `above_m` above the
  /// carriageway. A negative `above_m` is relative to the ground at the point itself, so that walls
  /// extend below the ground.
  Eigen::Vector3d point(double s_m, double d_m, double above_m) const;
  /// `profile` at each s of `stations_m`.
  std::vector<Ring> rings(const std::vector<double>& stations_m, const Profile& profile) const;

 private:
  const Ground& ground_;
};

/// Evenly spaced numbers from one end of `span_m` to the other, at most 5 m apart.
std::vector<double> stations_between(const Span& span_m);

}  // namespace croon::simulation

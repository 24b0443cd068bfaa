#pragma once

#include <cstddef>
#include <vector>

#include "framework/geometry/dof.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// A scene in which the points of a sensor are compared with the surfaces of a target.
struct ComparedScan {
  const Cloud* target = nullptr;
  const Cloud* source = nullptr;
  RigidTransform T_target_source;  ///< Within centimetres of the optimum.
};

/// A point of a sensor on a surface of the target.
struct SurfaceTouch {
  Vector6d by_pose = Vector6d::Zero();  ///< Jacobian of its distance with respect to `moved`.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();     ///< Of the surface, in the target's frame.
  double distance_m = 0.0;                              ///< Along the normal.
  Eigen::Vector3d of_source = Eigen::Vector3d::Zero();  ///< The point, in the sensor's frame.
  Eigen::Vector3d of_target = Eigen::Vector3d::Zero();  ///< The target's point, in its frame.
  double by_range = 0.0;    ///< The change of the distance per change of the point's range.
  double balance = 0.0;     ///< Weight of its direction: each of n points has n^-0.5.
  std::size_t surface = 0;  ///< Index of its surface, a region of 4 m with one direction.
};

/// The points of a scan on surfaces of its target.
struct SurfaceTouches {
  std::vector<SurfaceTouch> points;
  std::size_t surfaces = 0;
};

/// Of `max_points` points of the source, evenly spaced, those that lie on surfaces of the target:
/// within 0.5 m of a point of it, with a similar normal.
SurfaceTouches surface_touches(const ComparedScan& scan, std::size_t max_points);

/// The number of points to compare in each of `scans` scans: 3000 in all, at least 600 in each.
std::size_t touches_per_scan(std::size_t scans);

}  // namespace croon

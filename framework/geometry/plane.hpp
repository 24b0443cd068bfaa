#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// The plane `normal . p + offset_m = 0`; `normal` is a unit vector.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset_m = 0.0;

  /// Distance of `point` in metres, positive on the side that the normal points to.
  double signed_distance(const Eigen::Vector3d& point) const {
    return normal.dot(point) + offset_m;
  }
  /// The same plane seen from its other side.
  Plane flipped() const { return {-normal, -offset_m}; }
};

/// The least-squares plane through the points of `cloud` that `indices` names: through their mean,
/// across the direction of their least variance. Needs three points that are not on one line;
/// throws StageError.
Plane fit_plane(const PointCloud& cloud, const std::vector<int>& indices);

/// The indices of the points of `cloud` within `distance_m` of the plane, in order.
std::vector<int> points_within(const PointCloud& cloud, const Plane& plane, double distance_m);

}  // namespace croon

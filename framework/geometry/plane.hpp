#pragma once

#include <Eigen/Core>
#include <vector>

#include "framework/base/rng.hpp"
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

/// How plane_ransac searches.
struct PlaneRansacOptions {
  double threshold_m = 0.2;    ///< A plane holds the points within this distance of it.
  double confidence = 0.9999;  ///< Of having drawn three points of the fullest plane.
  int max_iterations = 10000;  ///< At most so many planes are drawn.
  int local_rounds = 4;        ///< How often a best plane so far is fitted again to its points.
  int sample_points = 5000;    ///< Planes are drawn from, and counted on, at most so many points.
};

/// The plane that holds the most points of `cloud`: RANSAC (Fischler and Bolles 1981) with a local
/// optimisation of each plane that is the best so far (Chum, Matas and Kittler 2003). Throws
/// StageError where no three points span a plane.
Plane plane_ransac(const PointCloud& cloud, const PlaneRansacOptions& options, Rng& rng);

}  // namespace croon

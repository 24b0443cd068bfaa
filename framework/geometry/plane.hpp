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

  /// Distance of `point` in metres, positive on the side of the normal.
  double signed_distance(const Eigen::Vector3d& point) const {
    return normal.dot(point) + offset_m;
  }
  /// The same plane with the opposite normal.
  Plane flipped() const { return {-normal, -offset_m}; }
};

/// The least-squares plane through the points of `cloud` at `indices`: it contains their mean, and
/// its normal is the direction of their minimum variance. Throws StageError for fewer than three
/// points or collinear ones.
Plane fit_plane(const Points& cloud, const std::vector<int>& indices);

/// The indices of the points of `cloud` within `distance_m` of the plane, in order.
std::vector<int> points_within(const Points& cloud, const Plane& plane, double distance_m);

/// The parameters of plane_ransac.
struct PlaneRansacOptions {
  double threshold_m = 0.2;    ///< Points within this distance of a plane are its inliers.
  double confidence = 0.9999;  ///< Probability of having drawn three inliers of the best plane.
  int max_iterations = 10000;  ///< Maximum number of planes drawn.
  int local_rounds = 4;        ///< Maximum number of refits of a new best plane to its inliers.
  int max_points = 5000;       ///< Maximum number of points for drawing planes and counting.
};

/// The plane with the most inliers in `cloud`: RANSAC (Fischler and Bolles 1981) with a local
/// optimisation of each new best plane (Chum, Matas and Kittler 2003). Throws StageError if no
/// three points span a plane.
Plane plane_ransac(const Points& cloud, const PlaneRansacOptions& options, Rng& rng);

}  // namespace croon

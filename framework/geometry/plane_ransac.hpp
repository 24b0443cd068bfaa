#pragma once

#include "framework/base/rng.hpp"
#include "framework/geometry/plane.hpp"
#include "framework/geometry/point_cloud.hpp"

namespace croon {

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

#pragma once

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Points with a unit normal each, `normals[i]` at `points[i]`; a normal's sign is arbitrary.
struct OrientedPoints {
  PointCloud points;
  PointCloud normals;
};

/// The first point of every cube of `leaf_size_m` that holds points of `cloud` (no two of them
/// coincide), each with its normal from the `neighbours` nearest of these points. Evens out a
/// LiDAR's density, so that the neighbours far away are not all of one ring. Points without a
/// normal are left out.
OrientedPoints oriented_sample(const PointCloud& cloud, double leaf_size_m, int neighbours);

}  // namespace croon

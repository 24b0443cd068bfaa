#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "framework/geometry/point_cloud.hpp"
#include "framework/spatial/kd_tree.hpp"

namespace croon {

/// The shape of a cloud around one of its points, from principal component analysis.
struct LocalShape {
  Eigen::Vector3f normal =
      Eigen::Vector3f::Zero();  ///< Unit, towards the sensor; zero where undefined.
  /// Least variance over the sum of the three (Pauly et al. 2002): 0 on a plane, 1/3 where it is
  /// round.
  float surface_variation = 0.0F;
};

/// Normals of a cloud by principal component analysis of each point's nearest neighbours (paper,
/// refinement: 40 of them). A normal is computed when it is first asked for and then kept: a
/// registration asks for few of a large target's. Any number of threads may ask; the answers do not
/// depend on who asks first.
class Normals {
 public:
  /// `points` and `tree` (over the same points) must outlive this.
  Normals(const PointCloud& points, const KdTree& tree, int neighbours);

  /// The shape around point `index`. Points with fewer than three neighbours apart have a zero
  /// normal.
  LocalShape at(int index) const;

 private:
  LocalShape computed(int index) const;

  const PointCloud& points_;
  const KdTree& tree_;
  int neighbours_;
  enum State : unsigned char { kEmpty, kBeingWritten, kReady };
  std::unique_ptr<std::atomic<unsigned char>[]> states_;
  mutable std::vector<LocalShape> shapes_;
};

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

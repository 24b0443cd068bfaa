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
      Eigen::Vector3f::Zero();  ///< Unit, towards the sensor; zero if undefined.
  /// The smallest variance over the sum of the three (Pauly et al. 2002): 0 on a plane, 1/3 for an
  /// isotropic neighbourhood.
  float surface_variation = 0.0F;
  /// The standard deviations of the neighbours along the surface, in the direction in which they
  /// spread farthest and across it. The neighbours of a far point lie on one ring.
  float length_m = 0.0F, breadth_m = 0.0F;
};

/// Normals of a cloud by principal component analysis of each point's nearest neighbours (paper,
/// refinement: 40 of them). A normal is computed on first use and cached, because a registration
/// needs only a few of a large target's. Thread-safe; the results do not depend on the order of the
/// calls.
class Normals {
 public:
  /// `points` and `tree` (over the same points) must outlive this.
  Normals(const Points& points, const KdTree& tree, int neighbours);

  /// The shape around point `index`. The normal is zero if the neighbours are fewer than three, or
  /// lie on one line.
  LocalShape at(int index) const {
    return states_[index].load(std::memory_order_acquire) == kReady ? shapes_[index]
                                                                    : first_at(index);
  }

 private:
  /// Computes the shape, and keeps it unless another thread does.
  LocalShape first_at(int index) const;
  LocalShape computed(int index) const;

  const Points& points_;
  const KdTree& tree_;
  int neighbours_;
  enum State : unsigned char { kEmpty, kBeingWritten, kReady };
  std::unique_ptr<std::atomic<unsigned char>[]> states_;
  mutable std::vector<LocalShape> shapes_;
};

/// Points with a unit normal each, `normals[i]` at `points[i]`; a normal's sign is arbitrary.
struct OrientedPoints {
  Points points;
  Points normals;
};

/// The first point of every cube of edge `leaf_size_m` that holds points of `cloud`, without
/// duplicates, each with its normal from the `neighbours` nearest of these points. This evens out
/// the density of a LiDAR's cloud, so that the neighbours of a distant point are not all on one
/// ring. Points without a normal are left out.
OrientedPoints oriented_sample(const Points& cloud, double leaf_size_m, int neighbours);

}  // namespace croon

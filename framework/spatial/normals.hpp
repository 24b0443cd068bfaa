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
  /// The minimum variance over the sum of all three (Pauly et al. 2002): 0 on a plane, 1/3 for an
  /// isotropic neighbourhood.
  float surface_variation = 0.0F;
  /// The standard deviations of the neighbours along the surface, in the direction of their maximum
  /// spread and across it. The neighbours of a distant point lie on one ring.
  float length_m = 0.0F, breadth_m = 0.0F;
};

/// Normals of a cloud by principal component analysis of each point's nearest neighbours (paper,
/// refinement: 40 of them). A normal is computed on first use and cached, because a registration
/// needs only a few normals of a large target. Thread-safe; the results do not depend on the order
/// of the calls.
class Normals {
 public:
  /// `points` and `tree` (over the same points) must outlive this.
  Normals(const Points& points, const KdTree& tree, int neighbours);

  /// The shape around point `index`. The normal is zero if there are fewer than three neighbours or
  /// they are collinear.
  LocalShape at(int index) const {
    return states_[index].load(std::memory_order_acquire) == kReady ? shapes_[index]
                                                                    : first_at(index);
  }

 private:
  /// Computes the shape and caches it unless another thread is doing so.
  LocalShape first_at(int index) const;
  LocalShape computed(int index) const;

  const Points& points_;
  const KdTree& tree_;
  int neighbours_;
  enum State : unsigned char { kEmpty, kBeingWritten, kReady };
  std::unique_ptr<std::atomic<unsigned char>[]> states_;
  mutable std::vector<LocalShape> shapes_;
};

/// Points with their unit normals, `normals[i]` at `points[i]`; the sign of a normal is arbitrary.
struct OrientedPoints {
  Points points;
  Points normals;
};

/// The first point in every cube of edge `leaf_size_m` that contains points of `cloud`, with its
/// normal estimated from the `neighbours` nearest of these points. This evens out the density of a
/// LiDAR's cloud, so that the neighbours of a distant point are not all on one ring. Points without
/// a normal are omitted.
OrientedPoints oriented_sample(const Points& cloud, double leaf_size_m, int neighbours);

}  // namespace croon

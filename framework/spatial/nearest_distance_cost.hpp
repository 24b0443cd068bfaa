#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "framework/geometry/rigid_transform.hpp"
#include "framework/spatial/cloud.hpp"

namespace croon {

/// The paper's cost of the rough calibration: the sum of the squared distances from the source's
/// points to their nearest neighbours in the target. Distances are truncated at `max_distance_m`,
/// because a point that the target does not see carries no information about the pose.
class NearestDistanceCost {
 public:
  /// Uses at most `max_points` of the source, evenly spaced.
  NearestDistanceCost(std::shared_ptr<const Cloud> target, const Cloud& source, int max_points,
                      double max_distance_m);

  /// The mean over the points, m^2, so that costs of different clouds are comparable.
  double operator()(const RigidTransform& T_target_source) const;

  /// The source's points that are used, in its frame, m.
  const Points& points() const { return points_; }
  /// An estimate of the cost from a few evenly spaced points.
  double cheap_estimate(const RigidTransform& T_target_source) const;

  /// The point of the target nearest to `point_in_target`, within `reach_m`. `near` is the index of
  /// a target point that is known to be near, or -1; it bounds the search and does not change the
  /// result.
  Neighbour nearest(const Eigen::Vector3f& point_in_target, float reach_m, int near = -1) const;
  /// The summand of a point with this nearest neighbour: its squared truncated distance, m^2.
  double addend_m2(const Neighbour& nearest) const;
  float max_distance_m() const { return max_distance_m_; }

 private:
  /// The mean over `count` evenly spaced points.
  double mean_of(std::size_t count, const RigidTransform& T_target_source) const;

  std::shared_ptr<const Cloud> target_;
  const KdTree& tree_;
  Points points_;
  float max_distance_m_;
};

}  // namespace croon

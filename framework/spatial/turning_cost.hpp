#pragma once

#include <map>
#include <vector>

#include "framework/spatial/nearest_distance_cost.hpp"

namespace croon {

/// The NearestDistanceCost of a sensor that turns about an axis through itself, for searches that
/// ask only whether one angle costs less than another.
///
/// A point at the distance r from the axis moves by at most r |a - b| between the angles a and b,
/// and its distance to the target changes by no more than that. So what is known at one angle
/// bounds the cost at another from below, and most sums need few searches of neighbours to show
/// that they are not the least. The points that were far from the target at the nearest angle are
/// searched first, because they raise the sum most. A search looks farther than the cost does, so
/// that a point beyond its largest distance is known to be there at the next angles too. None of
/// this changes a result. One thread at a time.
class TurningCost {
 public:
  /// `axis` is a unit vector in the target's frame.
  TurningCost(NearestDistanceCost cost, const RigidTransform& start, const Eigen::Vector3d& axis);

  /// The pose of the source in the target's frame after a turn from the start.
  RigidTransform turned(double angle_rad) const;

  /// The cost of that pose, m^2, to the last bit.
  double operator()(double angle_rad);

  /// The same if it is below `enough_m2`, else a number that is not.
  double below(double angle_rad, double enough_m2);

  /// The cost of a few of the points, m^2.
  double glance(double angle_rad) const;

 private:
  /// One point of the source.
  struct Turning {
    Eigen::Vector3f point;
    std::size_t index = 0;    ///< Its place among the points of the cost.
    float radius_m = 0.0F;    ///< At least its distance from the axis.
    float rounding_m = 0.0F;  ///< More than the error of its position and distances.
  };
  /// What is known of the distances to the target at one angle, in the order of `points_`.
  struct Known {
    std::vector<float> at_least_m;  ///< May be more than the cost's largest distance.
    /// Of the point as it was last searched, at an angle nearby: how far its nearest neighbour is,
    /// at most the cost's largest distance, and which that is, -1 if none was found.
    std::vector<float> expected_m;
    std::vector<int> nearest;
  };

  /// What the angles around this one tell of it.
  Known known_at(double angle_rad) const;
  void keep(double angle_rad, Known known);
  /// What the point at place `i` of `points_` adds to the sum at least, m^2.
  double addend_at_least_m2(const Known& known, std::size_t i) const;
  /// The places in `points_`, those first whose search is expected to raise the sum most.
  std::vector<std::size_t> promising_first(const Known& known) const;

  NearestDistanceCost cost_;
  RigidTransform start_;
  Eigen::Vector3d axis_;
  std::vector<Turning> points_;  ///< Farthest from the axis first: they change the most.
  std::map<double, Known> known_;
};

}  // namespace croon

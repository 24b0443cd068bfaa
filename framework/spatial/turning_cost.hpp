#pragma once

#include <map>
#include <vector>

#include "framework/spatial/nearest_distance_cost.hpp"

namespace croon {

/// The NearestDistanceCost of a sensor that turns about an axis through itself, for searches that
/// only need to know whether one angle costs less than another.
///
/// A point at the distance r from the axis moves by at most r |a - b| between the angles a and b,
/// and its distance to the target changes by no more than that. So distances known at one angle
/// bound the cost at another from below, and most sums need few neighbour searches to rule them
/// out as the minimum. The points that were far from the target at the nearest angle are searched
/// first, because they increase the sum most. The search radius exceeds the cost's maximum
/// distance, so that a point beyond that distance is known to be beyond it at nearby angles too.
/// None of this changes a result. Not thread-safe.
class TurningCost {
 public:
  /// `axis` is a unit vector in the target's frame.
  TurningCost(NearestDistanceCost cost, const RigidTransform& start, const Eigen::Vector3d& axis);

  /// The pose of the source in the target's frame after a turn from the start.
  RigidTransform turned(double angle_rad) const;

  /// The cost of that pose, m^2; exact to the last bit.
  double operator()(double angle_rad);

  /// The same if it is below `upper_bound_m2`, otherwise any number that is not below it.
  double below(double angle_rad, double upper_bound_m2);

  /// An estimate of the cost from a few of the points, m^2.
  double cheap_estimate(double angle_rad) const;

 private:
  /// One point of the source.
  struct Turning {
    Eigen::Vector3f point;
    std::size_t index = 0;    ///< Its index among the points of the cost.
    float radius_m = 0.0F;    ///< At least its distance from the axis.
    float rounding_m = 0.0F;  ///< An upper bound of the error of its position and distances.
  };
  /// What is known about the distances to the target at one angle, in the order of `points_`.
  struct Known {
    std::vector<float> at_least_m;  ///< Lower bounds; may exceed the cost's maximum distance.
    /// Results of the last search for a point, at a nearby angle: the distance of its nearest
    /// neighbour, at most the cost's maximum distance, and the neighbour's index (-1: none found).
    std::vector<float> expected_m;
    std::vector<int> nearest;
  };

  /// The bounds for this angle that follow from its neighbours among the known angles.
  Known known_at(double angle_rad) const;
  void keep(double angle_rad, Known known);
  /// The minimum summand of the point `i` of `points_`, m^2.
  double addend_at_least_m2(const Known& known, std::size_t i) const;
  /// The indices of `points_`, ordered by how much their search is expected to increase the sum.
  std::vector<std::size_t> promising_first(const Known& known) const;

  NearestDistanceCost cost_;
  RigidTransform start_;
  Eigen::Vector3d axis_;
  std::vector<Turning> points_;  ///< Farthest from the axis first: they change the most.
  std::map<double, Known> known_;
};

}  // namespace croon

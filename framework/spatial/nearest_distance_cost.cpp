#include "framework/spatial/nearest_distance_cost.hpp"

#include <algorithm>
#include <cmath>

#include "framework/spatial/evenly_spaced.hpp"

namespace croon {

NearestDistanceCost::NearestDistanceCost(std::shared_ptr<const Cloud> target, const Cloud& source,
                                         int max_points, double max_distance_m)
    : target_(std::move(target)),
      tree_(target_->kd_tree()),
      points_(evenly_spaced(source.points(), max_points)),
      max_distance_m_(static_cast<float>(max_distance_m)) {}

Neighbour NearestDistanceCost::nearest(const Eigen::Vector3f& point_in_target, float reach_m,
                                       int near) const {
  if (near < 0) return tree_.nearest(point_in_target, reach_m);
  constexpr float kMoreThanRounding = 1.00001F;
  const float near_m2 = croon::squared_distance_m2(point_in_target, target_->points()[near]);
  return tree_.nearest(point_in_target, std::min(reach_m, std::sqrt(near_m2) * kMoreThanRounding));
}

double NearestDistanceCost::addend_m2(const Neighbour& nearest) const {
  const bool is_within =
      nearest && nearest.squared_distance_m2 <= max_distance_m_ * max_distance_m_;
  return is_within ? static_cast<double>(nearest.squared_distance_m2)
                   : static_cast<double>(max_distance_m_) * max_distance_m_;
}

double NearestDistanceCost::mean_of(std::size_t count,
                                    const RigidTransform& T_target_source) const {
  const Eigen::Matrix3f R = T_target_source.rotation.cast<float>();
  const Eigen::Vector3f t = T_target_source.translation.cast<float>();
  double sum = 0.0;
  for (std::size_t n = 0; n < count; ++n) {
    const Eigen::Vector3f& point = points_[evenly_spaced_index(n, points_.size(), count)];
    sum += addend_m2(nearest(R * point + t, max_distance_m_));
  }
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

double NearestDistanceCost::operator()(const RigidTransform& T_target_source) const {
  return mean_of(points_.size(), T_target_source);
}

double NearestDistanceCost::cheap_estimate(const RigidTransform& T_target_source) const {
  constexpr std::size_t kFew = 48;
  return mean_of(std::min(points_.size(), kFew), T_target_source);
}

}  // namespace croon

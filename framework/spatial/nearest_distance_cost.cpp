#include "framework/spatial/nearest_distance_cost.hpp"

#include "framework/spatial/evenly_spaced.hpp"

namespace croon {

NearestDistanceCost::NearestDistanceCost(std::shared_ptr<const Cloud> target, const Cloud& source,
                                         int max_points, double max_distance_m)
    : target_(std::move(target)),
      tree_(target_->kd_tree()),
      points_(evenly_spaced(source.points(), max_points)),
      max_distance_m_(static_cast<float>(max_distance_m)) {}

double NearestDistanceCost::squared_distance_m2(const Eigen::Vector3f& point_in_target) const {
  const Neighbour nearest = tree_.nearest(point_in_target, max_distance_m_);
  return nearest ? static_cast<double>(nearest.squared_distance_m2)
                 : static_cast<double>(max_distance_m_) * max_distance_m_;
}

double NearestDistanceCost::operator()(const RigidTransform& T_target_source) const {
  const Eigen::Matrix3f R = T_target_source.rotation.cast<float>();
  const Eigen::Vector3f t = T_target_source.translation.cast<float>();
  double sum = 0.0;
  for (const Eigen::Vector3f& point : points_) sum += squared_distance_m2(R * point + t);
  return points_.empty() ? 0.0 : sum / static_cast<double>(points_.size());
}

}  // namespace croon

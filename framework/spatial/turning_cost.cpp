#include "framework/spatial/turning_cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace croon {
namespace {

/// More than the relative error of a few operations in single precision.
constexpr float kSingleRounding = 1e-6F;

/// The most bounds that are kept: 64 MB.
constexpr std::size_t kMostBounds = 16'000'000;

}  // namespace

TurningCost::TurningCost(NearestDistanceCost cost, const RigidTransform& start,
                         const Eigen::Vector3d& axis)
    : cost_(std::move(cost)), start_(start), axis_(axis) {
  const float away_m = static_cast<float>(start.translation.norm()) + cost_.max_distance_m();
  for (const Eigen::Vector3f& point : cost_.points()) {
    const Eigen::Vector3d arm = start.rotation * point.cast<double>();
    points_.push_back({point, points_.size(),
                       static_cast<float>(axis.cross(arm).norm()) * (1.0F + kSingleRounding),
                       (point.norm() + away_m) * kSingleRounding});
  }
  std::stable_sort(points_.begin(), points_.end(),
                   [](const Turning& a, const Turning& b) { return a.radius_m > b.radius_m; });
}

RigidTransform TurningCost::turned(double angle_rad) const {
  return {rotation_exp(angle_rad * axis_) * start_.rotation, start_.translation};
}

double TurningCost::operator()(double angle_rad) {
  return below(angle_rad, std::numeric_limits<double>::infinity());
}

TurningCost::Bounds TurningCost::bounds_at(double angle_rad) const {
  Bounds bounds(points_.size(), 0.0F);
  const auto raise = [&](const std::pair<const double, Bounds>& known) {
    const float turn_rad = static_cast<float>(std::abs(angle_rad - known.first)) + kSingleRounding;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
      const Turning& point = points_[i];
      bounds[i] =
          std::max(bounds[i], known.second[i] - point.radius_m * turn_rad - point.rounding_m);
    }
  };
  const auto next = known_.lower_bound(angle_rad);
  if (next != known_.end()) raise(*next);
  if (next != known_.begin()) raise(*std::prev(next));
  return bounds;
}

void TurningCost::keep(double angle_rad, Bounds bounds) {
  if (known_.size() * points_.size() < kMostBounds) known_[angle_rad] = std::move(bounds);
}

double TurningCost::below(double angle_rad, double enough_m2) {
  if (points_.empty()) return 0.0;
  const RigidTransform T = turned(angle_rad);
  const Eigen::Matrix3f R = T.rotation.cast<float>();
  const Eigen::Vector3f t = T.translation.cast<float>();
  const double count = static_cast<double>(points_.size());
  Bounds bounds = bounds_at(angle_rad);

  // The sum is at least this much: what has been searched, and the bounds of all other points. It
  // is compared with a little more than enough, because it is summed in another order than a mean.
  double at_least = 0.0;
  for (const float bound : bounds) at_least += static_cast<double>(bound) * bound;
  const double enough = enough_m2 * count * (1.0 + 1e-9);
  std::vector<double> squared_distances_m2(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (at_least >= enough) {
      keep(angle_rad, std::move(bounds));
      return at_least / count;
    }
    const double squared_m2 = cost_.squared_distance_m2(R * points_[i].point + t);
    squared_distances_m2[points_[i].index] = squared_m2;
    at_least += squared_m2 - static_cast<double>(bounds[i]) * bounds[i];
    bounds[i] = static_cast<float>(std::sqrt(squared_m2));
  }
  keep(angle_rad, std::move(bounds));
  return std::accumulate(squared_distances_m2.begin(), squared_distances_m2.end(), 0.0) / count;
}

}  // namespace croon

#include "framework/spatial/turning_cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace croon {
namespace {

/// More than the relative error of a few operations in single precision.
constexpr float kSingleRounding = 1e-6F;

/// The search radius over the cost's maximum distance.
constexpr float kLooksFarther = 1.5F;

/// Bounds are kept for at most this many points, summed over all angles: 64 MB, 12 bytes each.
constexpr std::size_t kMaxKnownPoints = 5'300'000;

}  // namespace

TurningCost::TurningCost(NearestDistanceCost cost, const RigidTransform& start,
                         const Eigen::Vector3d& axis)
    : cost_(std::move(cost)), start_(start), axis_(axis) {
  const float away_m =
      static_cast<float>(start.translation.norm()) + kLooksFarther * cost_.max_distance_m();
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

TurningCost::Known TurningCost::known_at(double angle_rad) const {
  Known here{std::vector<float>(points_.size(), 0.0F),
             std::vector<float>(points_.size(), cost_.max_distance_m()),
             std::vector<int>(points_.size(), -1)};
  const auto raise = [&](const std::pair<const double, Known>& there) {
    const float turn_rad = static_cast<float>(std::abs(angle_rad - there.first)) + kSingleRounding;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const float moved_m = points_[i].radius_m * turn_rad + points_[i].rounding_m;
      here.at_least_m[i] = std::max(here.at_least_m[i], there.second.at_least_m[i] - moved_m);
    }
    return turn_rad;
  };
  const Known* nearest = nullptr;
  const auto next = known_.lower_bound(angle_rad);
  float to_next_rad = std::numeric_limits<float>::infinity();
  if (next != known_.end()) {
    to_next_rad = raise(*next);
    nearest = &next->second;
  }
  if (next != known_.begin()) {
    const auto previous = std::prev(next);
    if (raise(*previous) < to_next_rad) nearest = &previous->second;
  }
  if (nearest != nullptr) {
    here.expected_m = nearest->expected_m;
    here.nearest = nearest->nearest;
  }
  return here;
}

void TurningCost::keep(double angle_rad, Known known) {
  if (known_.size() * points_.size() < kMaxKnownPoints) known_[angle_rad] = std::move(known);
}

double TurningCost::addend_at_least_m2(const Known& known, std::size_t i) const {
  const double distance_m = std::min(known.at_least_m[i], cost_.max_distance_m());
  return distance_m * distance_m;
}

std::vector<std::size_t> TurningCost::promising_first(const Known& known) const {
  // A few classes suffice: the order within a class matters little, and a full sort costs as much
  // as a hundred searches.
  constexpr std::size_t kClasses = 16;
  const float most_m2 = cost_.max_distance_m() * cost_.max_distance_m();
  std::vector<std::uint8_t> classes(points_.size());
  std::array<std::size_t, kClasses + 1> begins = {};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const float raise_m2 = known.expected_m[i] * known.expected_m[i] -
                           static_cast<float>(addend_at_least_m2(known, i));
    const float share = std::clamp(1.0F - raise_m2 / most_m2, 0.0F, 0.999F);
    classes[i] = static_cast<std::uint8_t>(share * kClasses);
    ++begins[classes[i] + 1];
  }
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<std::size_t> places(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) places[begins[classes[i]]++] = i;
  return places;
}

double TurningCost::below(double angle_rad, double upper_bound_m2) {
  if (points_.empty()) return 0.0;
  const RigidTransform T = turned(angle_rad);
  const Eigen::Matrix3f R = T.rotation.cast<float>();
  const Eigen::Vector3f t = T.translation.cast<float>();
  const double count = static_cast<double>(points_.size());
  Known here = known_at(angle_rad);

  // A lower bound of the sum: the searched points, and the bounds of all others. It is compared
  // with slightly more than the limit, because the order of summation differs from that of a mean.
  double at_least_m2 = 0.0;
  for (std::size_t i = 0; i < points_.size(); ++i) at_least_m2 += addend_at_least_m2(here, i);
  const double upper_bound = upper_bound_m2 * count * (1.0 + 1e-9);
  const float reach_m = kLooksFarther * cost_.max_distance_m();
  std::vector<double> addends_m2(points_.size());
  for (const std::size_t i : promising_first(here)) {
    if (at_least_m2 >= upper_bound) {
      keep(angle_rad, std::move(here));
      return at_least_m2 / count;
    }
    double& addend_m2 = addends_m2[points_[i].index];
    if (here.at_least_m[i] > cost_.max_distance_m()) {
      addend_m2 = cost_.addend_m2({});
      continue;
    }
    const Neighbour nearest = cost_.nearest(R * points_[i].point + t, reach_m, here.nearest[i]);
    addend_m2 = cost_.addend_m2(nearest);
    at_least_m2 += addend_m2 - addend_at_least_m2(here, i);
    here.at_least_m[i] = nearest ? std::sqrt(nearest.squared_distance_m2) : reach_m;
    here.expected_m[i] = std::min(here.at_least_m[i], cost_.max_distance_m());
    here.nearest[i] = nearest.index;
  }
  keep(angle_rad, std::move(here));
  return std::accumulate(addends_m2.begin(), addends_m2.end(), 0.0) / count;
}

double TurningCost::cheap_estimate(double angle_rad) const {
  return cost_.cheap_estimate(turned(angle_rad));
}

}  // namespace croon

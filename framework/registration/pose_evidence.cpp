#include "framework/registration/pose_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon {
namespace {

// Criteria for agreement and contradiction.
constexpr double kMaxDistance_m = 0.5;       // To the nearest point of the other cloud.
constexpr double kMaxPlaneDistance_m = 0.1;  // To the plane through it.
constexpr double kMaxNormalAngle_deg = 30.0;
constexpr double kRangeMargin_m = 0.4;  // Ranges that differ by at most this agree,
constexpr double kRangeRatio = 0.02;    // or by at most this fraction of the range.

bool is_visible(Sight sight) { return sight != Sight::unseen && sight != Sight::hidden; }

std::vector<Sight> one_way(const SensorView& target, const SensorView& source,
                           const RigidTransform& T) {
  const KdTree& tree = target.thinned->kd_tree();
  const Normals& target_normals = target.thinned->normals(target.normal_neighbours);
  const Normals& source_normals = source.thinned->normals(source.normal_neighbours);
  const double min_cosine = std::cos(rad_from_deg(kMaxNormalAngle_deg));
  const auto agrees = [&](int index, const Eigen::Vector3d& point) {
    const Neighbour nearest = tree.nearest(point.cast<float>(), static_cast<float>(kMaxDistance_m));
    if (!nearest) return false;
    const Eigen::Vector3d normal = target_normals.at(nearest.index).normal.cast<double>();
    const Eigen::Vector3d offset = point - target.thinned->points()[nearest.index].cast<double>();
    if (std::abs(normal.dot(offset)) > kMaxPlaneDistance_m) return false;
    const Eigen::Vector3d other = T.rotation * source_normals.at(index).normal.cast<double>();
    return std::abs(normal.dot(other)) >= min_cosine;
  };
  const auto sight_of = [&](int index) {
    const Eigen::Vector3d point = T * source.thinned->points()[index].cast<double>();
    const auto seen = target.image.at(point);
    if (!seen) return Sight::unseen;
    const double range_m = point.norm();
    const double margin_m = std::max(kRangeMargin_m, kRangeRatio * range_m);
    if (range_m > seen->farthest_m + margin_m) return Sight::hidden;
    if (range_m < seen->nearest_m - margin_m) return Sight::violates;
    return agrees(index, point) ? Sight::agrees : Sight::disagrees;
  };
  std::vector<Sight> sights;
  sights.reserve(source.sample.size());
  for (const int index : source.sample) sights.push_back(sight_of(index));
  return sights;
}

double count(const std::vector<Sight>& sights, Sight sight) {
  return static_cast<double>(std::count(sights.begin(), sights.end(), sight));
}

double visible(const std::vector<Sight>& sights) {
  return static_cast<double>(std::count_if(sights.begin(), sights.end(), is_visible));
}

double ratio(double part, double all) { return all > 0.0 ? part / all : 0.0; }

/// The fraction of the visible points that are `sight`, in both directions.
double visible_share(const PoseEvidence& evidence, Sight sight) {
  return ratio(count(evidence.source, sight) + count(evidence.target, sight),
               visible(evidence.source) + visible(evidence.target));
}

/// A visible point's vote for a pose.
double vote(Sight sight) {
  return sight == Sight::agrees ? 1.0 : sight == Sight::violates ? -1.0 : 0.0;
}

/// The votes of the points that are visible at both of two poses.
struct Votes {
  double points = 0.0;
  double difference = 0.0, square_sum = 0.0;  ///< Of the votes for the first and for the other.

  void add(const std::vector<Sight>& first, const std::vector<Sight>& other) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (!is_visible(first[i]) || !is_visible(other[i])) continue;
      const double difference_here = vote(first[i]) - vote(other[i]);
      points += 1.0;
      difference += difference_here;
      square_sum += difference_here * difference_here;
    }
  }
};

}  // namespace

double PoseEvidence::overlap_ratio() const { return visible_share(*this, Sight::agrees); }

double PoseEvidence::violation_ratio() const { return visible_share(*this, Sight::violates); }

double PoseEvidence::score() const {
  const auto of = [](const std::vector<Sight>& sights) {
    return ratio(2.0 * count(sights, Sight::agrees) - count(sights, Sight::disagrees) -
                     4.0 * count(sights, Sight::violates),
                 2.0 * static_cast<double>(sights.size()));
  };
  return of(source) + of(target);
}

std::optional<double> lead_over(const PoseEvidence& evidence, const PoseEvidence& other) {
  constexpr double kMinCommonShare = 0.4;
  Votes common;
  common.add(evidence.source, other.source);
  common.add(evidence.target, other.target);
  const double visible_at_first = visible(evidence.source) + visible(evidence.target);
  if (common.points == 0.0 || common.points < kMinCommonShare * visible_at_first) {
    return std::nullopt;
  }
  return common.difference / std::sqrt(std::max(1.0, common.square_sum));
}

PoseEvidence pose_evidence(const SensorView& target, const SensorView& source,
                           const RigidTransform& T_target_source) {
  return {one_way(target, source, T_target_source),
          one_way(source, target, T_target_source.inverse())};
}

}  // namespace croon

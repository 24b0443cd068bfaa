#include "framework/registration/pose_evidence.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/angles.hpp"

namespace croon {
namespace {

OneWayEvidence one_way(const SensorView& target, const SensorView& source, const RigidTransform& T,
                       const EvidenceOptions& options) {
  const KdTree& tree = target.thinned->kd_tree();
  const Normals& target_normals = target.thinned->normals(target.normal_neighbours);
  const Normals& source_normals = source.thinned->normals(source.normal_neighbours);
  const double min_cosine = std::cos(rad_from_deg(options.max_normal_angle_deg));
  const auto agrees = [&](int index, const Eigen::Vector3d& point) {
    const Neighbour nearest =
        tree.nearest(point.cast<float>(), static_cast<float>(options.max_distance_m));
    if (!nearest) return false;
    const Eigen::Vector3d normal = target_normals.at(nearest.index).normal.cast<double>();
    const Eigen::Vector3d offset = point - target.thinned->points()[nearest.index].cast<double>();
    if (std::abs(normal.dot(offset)) > options.max_plane_distance_m) return false;
    const Eigen::Vector3d other = T.rotation * source_normals.at(index).normal.cast<double>();
    return std::abs(normal.dot(other)) >= min_cosine;
  };
  OneWayEvidence evidence;
  evidence.points = static_cast<int>(source.sample.size());
  for (const int index : source.sample) {
    const Eigen::Vector3d point = T * source.thinned->points()[index].cast<double>();
    const auto seen = target.image.at(point);
    const double range_m = point.norm();
    const double margin_m = std::max(options.range_margin_m, options.range_ratio * range_m);
    if (!seen) {
      ++evidence.unseen;
    } else if (range_m > seen->farthest_m + margin_m) {
      ++evidence.hidden;
    } else if (range_m < seen->nearest_m - margin_m) {
      ++evidence.violate;
    } else {
      ++(agrees(index, point) ? evidence.agree : evidence.disagree);
    }
  }
  return evidence;
}

double ratio(int part, int all) { return all > 0 ? static_cast<double>(part) / all : 0.0; }

int visible(const OneWayEvidence& evidence) {
  return evidence.agree + evidence.disagree + evidence.violate;
}

}  // namespace

double PoseEvidence::overlap_ratio() const {
  return ratio(source.agree + target.agree, visible(source) + visible(target));
}

double PoseEvidence::violation_ratio() const {
  return ratio(source.violate + target.violate, visible(source) + visible(target));
}

double PoseEvidence::score() const {
  const auto of = [](const OneWayEvidence& e) {
    return ratio(2 * e.agree - e.disagree - 4 * e.violate, 2 * e.points);
  };
  return of(source) + of(target);
}

PoseEvidence pose_evidence(const SensorView& target, const SensorView& source,
                           const RigidTransform& T_target_source, const EvidenceOptions& options) {
  return {one_way(target, source, T_target_source, options),
          one_way(source, target, T_target_source.inverse(), options)};
}

}  // namespace croon

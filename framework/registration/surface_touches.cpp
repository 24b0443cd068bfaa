#include "framework/registration/surface_touches.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/registration/gauss_newton.hpp"
#include "framework/registration/surface_key.hpp"
#include "framework/spatial/evenly_spaced.hpp"

namespace croon {

SurfaceTouches surface_touches(const ComparedScan& scan, std::size_t max_points) {
  constexpr double kMinNormalCosine = 0.8, kSurfaceSize_m = 4.0;
  constexpr float kMaxDistance_m = 0.5F;
  constexpr int kNeighbours = 10;
  const Points& points = scan.source->points();
  const Normals& target_normals = scan.target->normals(kNeighbours);
  const Normals& source_normals = scan.source->normals(kNeighbours);
  const RigidTransform& T = scan.T_target_source;
  const std::size_t count = std::min(points.size(), max_points);
  SurfaceTouches touches;
  std::map<SurfaceKey, std::size_t> surfaces;
  std::vector<int> directions;
  DirectionCounts counts{};
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = evenly_spaced_index(i, points.size(), count);
    SurfaceTouch touch;
    touch.of_source = points[index].cast<double>();
    const Eigen::Vector3d arm = T.rotation * touch.of_source;
    const Eigen::Vector3d in_target = arm + T.translation;
    const Neighbour nearest =
        scan.target->kd_tree().nearest(in_target.cast<float>(), kMaxDistance_m);
    if (!nearest || !(arm.norm() > 0.0)) continue;
    touch.normal = target_normals.at(nearest.index).normal.cast<double>();
    const Eigen::Vector3d own =
        T.rotation * source_normals.at(static_cast<int>(index)).normal.cast<double>();
    if (!(std::abs(touch.normal.dot(own)) > kMinNormalCosine)) continue;
    touch.by_pose = plane_jacobian(arm, touch.normal);
    touch.of_target = scan.target->points()[static_cast<std::size_t>(nearest.index)].cast<double>();
    touch.distance_m = touch.normal.dot(in_target - touch.of_target);
    touch.by_range = touch.normal.dot(arm) / arm.norm();
    const SurfaceKey key = surface_key(in_target, touch.normal, kSurfaceSize_m);
    touch.surface = surfaces.try_emplace(key, surfaces.size()).first->second;
    directions.push_back(key.second);
    ++counts.at(static_cast<std::size_t>(key.second));
    touches.points.push_back(touch);
  }
  const auto weights = direction_weights(counts, 0.5);
  for (std::size_t i = 0; i < touches.points.size(); ++i) {
    touches.points[i].balance = weights.at(static_cast<std::size_t>(directions[i]));
  }
  touches.surfaces = surfaces.size();
  return touches;
}

std::size_t touches_per_scan(std::size_t scans) {
  constexpr std::size_t kPoints = 3000, kMinPoints = 600;
  return std::max(kPoints / std::max<std::size_t>(scans, 1), kMinPoints);
}

}  // namespace croon

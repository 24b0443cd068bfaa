#include "framework/spatial/ground_candidates.hpp"

#include <algorithm>

#include "framework/base/error.hpp"

namespace croon {
namespace {

Points within_range(const Points& cloud, double max_range_m) {
  Points near;
  for (const Eigen::Vector3f& point : cloud) {
    if (point.cast<double>().norm() <= max_range_m) near.push_back(point);
  }
  return near;
}

/// The plane refitted to its inliers near the sensor, where a road is flattest; its normal points
/// to the sensor.
Plane refitted(const Points& points, const Plane& plane, double threshold_m) {
  constexpr double kNear_m = 12.0;
  std::vector<int> near;
  for (const int i : points_within(points, plane, threshold_m)) {
    if (points[i].cast<double>().norm() <= kNear_m) near.push_back(i);
  }
  constexpr std::size_t kMinNearPoints = 50;
  Plane fitted = plane;
  if (near.size() >= kMinNearPoints) {
    try {
      fitted = fit_plane(points, near);
    } catch (const StageError&) {
    }  // The points are collinear; keep the plane.
  }
  return fitted.offset_m < 0.0 ? fitted.flipped() : fitted;
}

double score_of(const Points& points, const Plane& plane, const GroundCandidateOptions& options) {
  int on = 0;
  int behind = 0;
  for (const Eigen::Vector3f& point : points) {
    const double distance_m = plane.signed_distance(point.cast<double>());
    if (distance_m < -options.below_margin_m) ++behind;
    if (std::abs(distance_m) <= options.threshold_m) ++on;
  }
  const auto all = static_cast<double>(points.size());
  return on / all - 2.0 * behind / all;
}

}  // namespace

std::vector<GroundCandidate> ground_candidates(const Points& thinned,
                                               const GroundCandidateOptions& options, Rng& rng) {
  const Points points = within_range(thinned, options.max_range_m);
  PlaneRansacOptions ransac;
  ransac.threshold_m = options.threshold_m;
  ransac.confidence = 0.999;
  ransac.max_iterations = 2000;
  ransac.local_rounds = 2;
  ransac.max_points = 2500;
  std::vector<GroundCandidate> found;
  Points rest = points;
  for (int i = 0; i < options.planes && rest.size() >= 50; ++i) {
    Plane plane;
    try {
      plane = plane_ransac(rest, ransac, rng);
    } catch (const StageError&) {
      break;  // The remaining points are collinear.
    }
    plane = plane.offset_m < 0.0 ? plane.flipped() : plane;
    Points left;
    for (const Eigen::Vector3f& point : rest) {
      if (std::abs(plane.signed_distance(point.cast<double>())) > options.threshold_m) {
        left.push_back(point);
      }
    }
    if (left.size() == rest.size()) break;
    rest = std::move(left);
    plane = refitted(points, plane, options.threshold_m);
    if (plane.offset_m < options.min_height_m || plane.offset_m > options.max_height_m) continue;
    found.push_back({plane, score_of(points, plane, options)});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  while (!found.empty() && found.back().score < found.front().score - options.max_gap) {
    found.pop_back();
  }
  if (found.size() > static_cast<std::size_t>(options.candidates)) found.resize(options.candidates);
  return found;
}

}  // namespace croon

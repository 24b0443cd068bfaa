#include "framework/pipeline/cloud_description.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/base/error.hpp"
#include "framework/base/statistics.hpp"
#include "framework/spatial/leaf_grid.hpp"

namespace croon {
namespace {

constexpr double kMinRange_m = 0.1;
constexpr double kBinsPerDecade = 8.0;

double volume_m3(const Points& points) {
  constexpr double kLeaf_m = 0.1;
  const LeafGrid grid(kLeaf_m);
  std::set<LeafKey> leaves;
  for (const Eigen::Vector3f& point : points) {
    leaves.insert(leaf_key(grid.leaf_of(point.cast<double>())));
  }
  return static_cast<double>(leaves.size()) * kLeaf_m * kLeaf_m * kLeaf_m;
}

double ground_ratio(const Points& points, const GroundExtractor& extractor) {
  // One stream for all clouds: a cloud's description depends only on the cloud.
  Rng rng(StreamKey(0).with("figures"));
  try {
    const Ground ground = extractor.extract(points, rng);
    const auto count = std::count(ground.is_ground.begin(), ground.is_ground.end(), 1);
    return static_cast<double>(count) / static_cast<double>(points.size());
  } catch (const StageError&) {
    return 0.0;
  }
}

std::size_t bin_of(double range_m) {
  const double bin =
      std::floor(kBinsPerDecade * std::log10(std::max(range_m, kMinRange_m) / kMinRange_m));
  return std::min(static_cast<std::size_t>(bin), kRangeBins - 1);
}

}  // namespace

double range_bin_m(std::size_t bin) {
  return kMinRange_m * std::pow(10.0, static_cast<double>(bin) / kBinsPerDecade);
}

CloudDescription description_of(const Points& points, const GroundExtractor& extractor) {
  CloudDescription description;
  description.points = points.size();
  description.ground_ratio = ground_ratio(points, extractor);
  description.occupied_volume_m3 = volume_m3(points);
  std::vector<double> ranges_m;
  for (const Eigen::Vector3f& point : points) {
    ranges_m.push_back(static_cast<double>(point.norm()));
    description.range_shares[bin_of(ranges_m.back())] += 1.0 / static_cast<double>(points.size());
  }
  description.median_range_m = median(std::move(ranges_m));
  return description;
}

void add_overlap(CloudDescription& description, const Points& points, const KdTree& reference,
                 const RigidTransform& T_reference_sensor) {
  constexpr float kNear_m = 1.0F;
  std::vector<double> distances_m;
  for (const Eigen::Vector3f& point : transformed(points, T_reference_sensor)) {
    const Neighbour nearest = reference.nearest(point, kNear_m);
    if (nearest) {
      distances_m.push_back(std::sqrt(static_cast<double>(nearest.squared_distance_m2)));
    }
  }
  description.overlap_ratio =
      static_cast<double>(distances_m.size()) / static_cast<double>(points.size());
  if (!distances_m.empty()) description.median_distance_m = median(std::move(distances_m));
}

}  // namespace croon

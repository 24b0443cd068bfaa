#include "framework/spatial/ground_regions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/base/statistics.hpp"
#include "framework/geometry/plane.hpp"

namespace croon {
namespace {

/// A zone of the concentric zone model: rings between two ranges, divided into sectors.
struct Zone {
  double share = 1.0;  ///< Outer radius, as a fraction of the way from min_range_m to max_range_m.
  int rings = 1;
  int sectors = 1;
};
/// The zones of Patchwork: sectors are wide near the sensor, where a narrow one has few rays, and
/// far from it, where points are sparse.
constexpr std::array<Zone, 4> kZones = {
    {{0.125, 2, 16}, {0.25, 4, 32}, {0.5, 4, 54}, {1.0, 4, 32}}};

/// A region's points on its plane, by index, and the plane.
struct Region {
  std::vector<int> on_plane;
  Plane plane;
  double elevation_m = 0.0;  ///< Mean elevation of its points.
  double flatness_m = 0.0;   ///< Root mean square distance of the points from the plane.
  bool is_near = false;      ///< In one of the two inner zones.
};

class GroundRegions {
 public:
  explicit GroundRegions(const GroundRegionOptions& options) : options_(options) {}

  /// The points of the ground regions; z points up.
  std::vector<int> ground_points(const Points& level) const {
    std::vector<Region> upright;
    for (const auto& [points, is_near] : regions_of(level)) {
      Region region = fitted(level, points);
      region.is_near = is_near;
      if (!region.on_plane.empty()) upright.push_back(std::move(region));
    }
    if (upright.empty()) {
      throw StageError("none of the regions around the sensor is upright; is the sensor level?");
    }
    const double road_m = road_elevation_m(upright);
    std::vector<int> ground;
    for (const Region& region : upright) {
      const bool is_level = std::abs(region.elevation_m - road_m) <= options_.max_elevation_m;
      // In the inner zones, an elevated flat region is a roof or a bonnet, not a slope.
      const bool is_slope = !region.is_near && region.flatness_m <= options_.max_flatness_m;
      if (!is_level && !is_slope) continue;
      ground.insert(ground.end(), region.on_plane.begin(), region.on_plane.end());
    }
    if (ground.size() < 3)
      throw StageError("no region is at the road's height; is the sensor level?");
    return ground;
  }

 private:
  /// The indices of the points in each region, and whether the region is near.
  std::vector<std::pair<std::vector<int>, bool>> regions_of(const Points& level) const {
    std::vector<std::pair<std::vector<int>, bool>> regions;
    std::array<std::size_t, kZones.size()> first{};
    for (std::size_t k = 0; k < kZones.size(); ++k) {
      first[k] = regions.size();
      regions.resize(regions.size() + static_cast<std::size_t>(kZones[k].rings * kZones[k].sectors),
                     {{}, k < 2});
    }
    for (std::size_t i = 0; i < level.size(); ++i) {
      const Eigen::Vector3d point = level[i].cast<double>();
      const double range_m = point.head<2>().norm();
      const double share =
          (range_m - options_.min_range_m) / (options_.max_range_m - options_.min_range_m);
      if (!(share >= 0.0 && share < 1.0)) continue;
      std::size_t k = 0;
      while (share >= kZones[k].share) ++k;
      const double begin = k == 0 ? 0.0 : kZones[k - 1].share;
      const auto& zone = kZones[k];
      const auto bin = [](double part, int bins) {
        return std::clamp(static_cast<int>(part * bins), 0, bins - 1);
      };
      const int ring = bin((share - begin) / (zone.share - begin), zone.rings);
      const double turn = 0.5 * (std::atan2(point.y(), point.x()) / kPi + 1.0);
      const int sector = bin(turn, zone.sectors);
      regions[first[k] + static_cast<std::size_t>(ring * zone.sectors + sector)].first.push_back(
          static_cast<int>(i));
    }
    return regions;
  }

  /// The plane at the bottom of a region, if its normal is nearly vertical ("upright"). A steeper
  /// plane is a wall: its points are removed and the region is fitted again (region-wise vertical
  /// plane fitting). Empty if no upright plane is found.
  Region fitted(const Points& level, std::vector<int> points) const {
    constexpr int kWalls = 3;
    const double min_cosine = std::cos(rad_from_deg(options_.max_tilt_deg));
    for (int round = 0; round <= kWalls; ++round) {
      if (static_cast<int>(points.size()) < options_.min_points) return {};
      Region region;
      try {
        region = lowest_plane(level, points);
      } catch (const StageError&) {
        return {};  // The points are collinear, e.g. of one ring.
      }
      if (static_cast<int>(region.on_plane.size()) < options_.min_points) return {};
      if (region.plane.normal.z() >= min_cosine) return region;
      std::vector<int> rest;
      std::set_difference(points.begin(), points.end(), region.on_plane.begin(),
                          region.on_plane.end(), std::back_inserter(rest));
      points = std::move(rest);
    }
    return {};
  }

  /// The plane fitted to the lowest points of a region, then to the points near it (region-wise
  /// plane fitting). Empty if fewer than three are near it.
  Region lowest_plane(const Points& level, const std::vector<int>& points) const {
    constexpr int kRounds = 3;
    Region region;
    region.on_plane = lowest_points(level, points);
    for (int round = 0; round < kRounds; ++round) {
      region = refitted(level, points, region.on_plane);
      if (region.on_plane.size() < 3) return {};
    }
    return region;
  }

  /// The points at most `seed_height_m` above the mean height of the lowest few.
  std::vector<int> lowest_points(const Points& level, const std::vector<int>& points) const {
    constexpr std::size_t kLowest = 20;
    std::vector<float> heights_m;
    for (const int i : points) heights_m.push_back(level[static_cast<std::size_t>(i)].z());
    const std::size_t count = std::min(kLowest, heights_m.size());
    const auto end = heights_m.begin() + static_cast<std::ptrdiff_t>(count);
    std::partial_sort(heights_m.begin(), end, heights_m.end());
    const double bottom_m =
        std::accumulate(heights_m.begin(), end, 0.0) / static_cast<double>(count);
    std::vector<int> lowest;
    for (const int i : points) {
      const double height_m = level[static_cast<std::size_t>(i)].z();
      if (height_m <= bottom_m + options_.seed_height_m) lowest.push_back(i);
    }
    return lowest;
  }

  /// The plane through the points `on_plane`, with its normal up, and the points near it.
  Region refitted(const Points& level, const std::vector<int>& points,
                  const std::vector<int>& on_plane) const {
    Region region;
    region.plane = fit_plane(level, on_plane);
    if (region.plane.normal.z() < 0.0) region.plane = region.plane.flipped();
    double elevations_m = 0.0;
    double squares_m2 = 0.0;
    for (const int i : points) {
      const Eigen::Vector3d point = level[static_cast<std::size_t>(i)].cast<double>();
      const double distance_m = region.plane.signed_distance(point);
      if (std::abs(distance_m) > options_.region_threshold_m) continue;
      region.on_plane.push_back(i);
      elevations_m += point.z();
      squares_m2 += distance_m * distance_m;
    }
    const auto count = static_cast<double>(std::max<std::size_t>(region.on_plane.size(), 1));
    region.elevation_m = elevations_m / count;
    region.flatness_m = std::sqrt(squares_m2 / count);
    return region;
  }

  /// The median elevation of the regions near the sensor, or of all regions if none is near.
  /// Patchwork learns it from scan to scan; here there is only one scan.
  static double road_elevation_m(const std::vector<Region>& regions) {
    std::vector<double> near_m;
    std::vector<double> all_m;
    for (const Region& region : regions) {
      all_m.push_back(region.elevation_m);
      if (region.is_near) near_m.push_back(region.elevation_m);
    }
    return median(near_m.empty() ? all_m : near_m);
  }

  GroundRegionOptions options_;
};

}  // namespace

std::vector<int> ground_region_points(const Points& level, const GroundRegionOptions& options) {
  return GroundRegions(options).ground_points(level);
}

}  // namespace croon

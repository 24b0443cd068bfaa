#pragma once

#include <vector>

#include "framework/geometry/point_cloud.hpp"

namespace croon {

/// Criteria for the regions of a cloud that are ground.
struct GroundRegionOptions {
  double min_range_m = 1.0;    ///< Horizontal; nearer points belong to no region.
  double max_range_m = 60.0;   ///< Likewise for farther points.
  int min_points = 10;         ///< Of a region, and of its plane.
  double seed_height_m = 0.3;  ///< Height of the points of the initial plane above the lowest.
  double region_threshold_m = 0.15;  ///< Points within this distance of a plane are on it.
  double max_tilt_deg = 30.0;        ///< Uprightness: angle between a region's normal and up.
  double max_elevation_m = 0.4;      ///< Elevation: above or below the road near the sensor.
  double max_flatness_m = 0.03;      ///< Flatness: root mean square distance from the plane.
};

/// The points of `level` (z up, the sensor at the origin), by index, that lie in ground regions.
/// The concentric zones around the sensor are divided into regions, and a plane is fitted to the
/// lowest points of each; a region is upright if the normal of its plane is nearly vertical, and
/// ground if it is upright and either at the road's height or, away from the sensor, flat. After
/// Lim, Oh and Myung, Patchwork, RA-L 2021, and Lee, Lim and Myung, Patchwork++, IROS 2022
/// (vertical planes are removed first). The road's height, which the papers assume as known or
/// track from scan to scan, is the median over the regions near the sensor. Throws StageError if no
/// region is upright.
std::vector<int> ground_region_points(const Points& level, const GroundRegionOptions& options);

}  // namespace croon

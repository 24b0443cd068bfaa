#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/spatial/kd_tree.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/ground_extractor.hpp"

namespace croon {

/// Bins of the histogram of ranges, from 0.1 m to 316 m, each 10^(1/8) times as wide as the last.
constexpr std::size_t kRangeBins = 28;

/// Numbers that describe one sensor's cloud in one scene.
struct CloudDescription {
  std::string dataset;  ///< Its name in reports.
  std::string scene;
  std::string kind;  ///< Of the scene; may be empty.
  std::string sensor;
  std::size_t points = 0;
  double ground_ratio = 0.0;  ///< Share of points on the largest plane; 0 without a plane.
  double median_range_m = 0.0;
  double occupied_volume_m3 = 0.0;  ///< Of leaves of 0.1 m, in the sensor's frame.
  /// Median distance to the nearest point of the reference's cloud at the true pose, over the
  /// points that have one within 1 m; std::nullopt without ground truth.
  std::optional<double> median_distance_m;
  std::optional<double> overlap_ratio;  ///< Share of points that have one within 1 m.
  std::array<double, kRangeBins> range_shares{};
};

/// The lower end of a bin, metres.
double range_bin_m(std::size_t bin);

/// Describes `points`, which must not be empty; `extractor` finds the ground. Names stay empty.
CloudDescription description_of(const Points& points, const GroundExtractor& extractor);

/// Adds the overlap with the reference's cloud; `points` are in the sensor's frame.
void add_overlap(CloudDescription& description, const Points& points, const KdTree& reference,
                 const RigidTransform& T_reference_sensor);

}  // namespace croon

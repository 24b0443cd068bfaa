#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "framework/spatial/kd_tree.hpp"
#include "framework/stage/dataset.hpp"
#include "framework/stage/ground_extractor.hpp"

namespace croon::experiments {

/// Bins of the histogram of ranges, from 0.1 m to 316 m, each 10^(1/8) times as wide as the last.
constexpr std::size_t kRangeBins = 28;

/// What one sensor's cloud in one scene looks like.
struct CloudFigures {
  std::string dataset;  ///< The experiment's name.
  std::string scene;
  std::string kind;  ///< Of the scene; may be empty.
  std::string sensor;
  std::size_t points = 0;
  double ground_ratio = 0.0;  ///< Share of points on the largest plane; 0 where there is none.
  double median_range_m = 0.0;
  double occupied_volume_m3 = 0.0;  ///< Of leaves of 0.1 m, in the sensor's frame.
  /// To the reference's nearest point by the truth, over the points that have one within 1 m.
  std::optional<double> median_distance_m;
  std::optional<double> overlap_ratio;  ///< Share of points that have one.
  std::array<double, kRangeBins> range_shares{};
};

/// The lower end of a bin, metres.
double range_bin_m(std::size_t bin);

/// The figures of `points`; `extractor` finds the ground. Names are left empty. Points must not be
/// none.
CloudFigures figures_of(const PointCloud& points, const GroundExtractor& extractor);

/// Adds what the cloud has in common with the reference's: `points` in the sensor's frame.
void add_overlap(CloudFigures& figures, const PointCloud& points, const KdTree& reference,
                 const RigidTransform& T_reference_sensor);

/// A table with a row per sensor and dataset: the medians over scenes, with the least and the
/// largest behind them where there are several.
std::string figures_table(const std::vector<CloudFigures>& figures);

/// The bytes of clouds.csv: a row per cloud.
std::string figures_csv(const std::vector<CloudFigures>& figures);

/// The ranges of each sensor as a picture (SVG): the share of points over the range, a line per
/// dataset, mean over scenes.
std::string ranges_svg(const std::vector<CloudFigures>& figures);

}  // namespace croon::experiments

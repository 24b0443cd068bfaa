#include <cmath>

#include "framework/base/angles.hpp"
#include "framework/base/error.hpp"
#include "framework/geometry/rigid_transform.hpp"
#include "framework/params/choice.hpp"
#include "framework/spatial/ground_candidates.hpp"
#include "framework/spatial/ground_regions.hpp"
#include "framework/stage/ground_from_planes.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::ground_extractor {
namespace {

/// How the upward direction in the sensor's frame is determined.
enum class Up { searched, sensor_z };
const params::Words<Up> kUpWords = {{"searched", Up::searched}, {"sensor_z", Up::sensor_z}};

struct Params : GroundRule, GroundRegionOptions {
  params::Slot<Preprocessor> thinning;
  Up up = Up::searched;
};

const params::Table<GroundRegionOptions>& region_table() {
  static const params::Table<GroundRegionOptions> table = {
      params::number("min_range_m", &GroundRegionOptions::min_range_m, {0.0, 100.0},
                     "Minimum horizontal distance of the regions from the sensor."),
      params::number("max_range_m", &GroundRegionOptions::max_range_m, {1.0, 1000.0},
                     "Maximum horizontal distance."),
      params::integer("min_points", &GroundRegionOptions::min_points, {3, 1000000},
                      "Minimum number of points in a region; others are ignored."),
      params::number("seed_height_m", &GroundRegionOptions::seed_height_m, {0.001, 10.0},
                     "A region's first plane is fitted to the points up to this height above its "
                     "lowest ones."),
      params::number("region_threshold_m", &GroundRegionOptions::region_threshold_m, {0.001, 10.0},
                     "Maximum distance of a region's inliers from its plane."),
      params::number(
          "max_tilt_deg", &GroundRegionOptions::max_tilt_deg, {0.0, 90.0},
          "Uprightness: maximum angle between a region's normal and the upward direction."),
      params::number("max_elevation_m", &GroundRegionOptions::max_elevation_m, {0.0, 100.0},
                     "Elevation: maximum height difference between a region and the median of the "
                     "upright regions near the sensor."),
      params::number("max_flatness_m", &GroundRegionOptions::max_flatness_m, {0.0, 10.0},
                     "Flatness: a region that exceeds max_elevation_m is kept as a slope if the "
                     "RMS distance of its inliers from its plane is at most this."),
  };
  return table;
}

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::slot("thinning", &Params::thinning,
                       R"({"type": "voxel_downsample", "leaf_size_m": 0.1})",
                       "Thins the cloud before it is divided into regions."),
          params::choice("up", &Params::up, kUpWords,
                         "`sensor_z`: the sensor is level, as the source assumes; if it is not, no "
                         "region is upright and the stage fails. `searched`: the upward direction "
                         "is the normal of the plane that plausible_plane finds."),
      }
          .inherit(region_table())
          .inherit(ground_rule_table())
          .require([](const Params& p) { return p.min_range_m <= p.max_range_m; },
                   "min_range_m must not exceed max_range_m");
  return table;
}

class Patchwork final : public GroundExtractor {
 public:
  explicit Patchwork(Params params) : params_(std::move(params)) {}

  Ground extract(const PointCloud& cloud, Rng& rng) const override {
    const Points thinned = params_.thinning->apply(cloud).points;
    const Eigen::Matrix3d R_level_sensor = levelling(thinned, rng);
    const Points level = transformed(thinned, {R_level_sensor, Eigen::Vector3d::Zero()});
    Points ground;
    for (const int i : ground_region_points(level, params_))
      ground.push_back(thinned[static_cast<std::size_t>(i)]);
    PlaneRansacOptions options;
    options.threshold_m = params_.threshold_m;
    const Plane plane = plane_ransac(ground, options, rng);
    const double cosine = std::abs((R_level_sensor * plane.normal).z());
    if (cosine < std::cos(rad_from_deg(params_.max_tilt_deg))) {
      throw StageError("the plane of the upright regions is not upright; is the sensor level?");
    }
    return ground_from_planes(cloud.points, {plane}, params_, rng);
  }

 private:
  /// The rotation from the upward direction to z.
  Eigen::Matrix3d levelling(const Points& cloud, Rng& rng) const {
    if (params_.up == Up::sensor_z) return Eigen::Matrix3d::Identity();
    GroundCandidateOptions options;
    options.candidates = 1;
    const auto candidates = ground_candidates(cloud, options, rng);
    if (candidates.empty())
      throw StageError("found no plausible ground plane, so the upward direction is unknown");
    return rotation_between(candidates.front().plane.normal, Eigen::Vector3d::UnitZ());
  }

  Params params_;
};

}  // namespace

StageEntry patchwork() {
  return stage_entry<Patchwork>(
      "patchwork",
      "Divides the cloud into concentric zones, fits a plane to the lowest points of each region, "
      "keeps the regions that are upright and at road height or flat, and fits a plane to their "
      "points.",
      "after Patchwork (Lim et al., RA-L 2021) and Patchwork++ (Lee et al., IROS 2022)", table());
}

}  // namespace croon::stages::ground_extractor

#include "framework/base/error.hpp"
#include "framework/spatial/ground_candidates.hpp"
#include "framework/stage/ground_from_planes.hpp"
#include "framework/stage/preprocessor.hpp"
#include "framework/stage/stage_entry.hpp"

namespace croon::stages::ground_extractor {
namespace {

struct Params : GroundRule {
  params::Slot<Preprocessor> thinning;
  double max_range_m = 40.0;
  double min_height_m = 0.2;
  double max_height_m = 6.0;
  int planes = 8;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table =
      params::Table<Params>{
          params::slot("thinning", &Params::thinning,
                       R"({"type": "voxel_downsample", "leaf_size_m": 0.25})",
                       "Equalises the density of the cloud, so that the plane with the largest "
                       "area is found instead of the one with the most points."),
          params::number("max_range_m", &Params::max_range_m, {1.0, 1000.0},
                         "Points farther from the sensor are ignored when planes are chosen."),
          params::number("min_height_m", &Params::min_height_m, {0.0, 100.0},
                         "Minimum height of the sensor above the ground."),
          params::number("max_height_m", &Params::max_height_m, {0.0, 100.0},
                         "Maximum height of the sensor above the ground."),
          params::integer("planes", &Params::planes, {1, 100},
                          "Number of planes that are extracted, the largest first."),
      }
          .inherit(ground_rule_table())
          .require([](const Params& p) { return p.min_height_m <= p.max_height_m; },
                   "min_height_m must not exceed max_height_m");
  return table;
}

class PlausiblePlane final : public GroundExtractor {
 public:
  explicit PlausiblePlane(Params params) : params_(std::move(params)) {}

  Ground extract(const PointCloud& cloud, Rng& rng) const override {
    GroundCandidateOptions options;
    options.max_range_m = params_.max_range_m;
    options.min_height_m = params_.min_height_m;
    options.max_height_m = params_.max_height_m;
    options.planes = params_.planes;
    options.candidates = 1;
    const PointCloud thinned = params_.thinning->apply(cloud);
    const auto candidates = ground_candidates(thinned.points, options, rng);
    if (candidates.empty()) throw StageError("found no plausible ground plane below the sensor");
    return ground_from_planes(cloud.points, {candidates.front().plane}, params_, rng);
  }

 private:
  Params params_;
};

}  // namespace

StageEntry plausible_plane() {
  return stage_entry<PlausiblePlane>(
      "plausible_plane",
      "Extracts the largest planes and chooses the most plausible ground: below the sensor, "
      "however it is mounted, with a large area and few returns behind it.",
      "croon", table());
}

}  // namespace croon::stages::ground_extractor

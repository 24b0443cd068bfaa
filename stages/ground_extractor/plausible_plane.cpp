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
                       "Makes the cloud even, so that the plane with the largest area is found and "
                       "not that with the most points."),
          params::number("max_range_m", &Params::max_range_m, {1.0, 1000.0},
                         "Points farther from the sensor choose no plane."),
          params::number("min_height_m", &Params::min_height_m, {0.0, 100.0},
                         "The sensor is at least this far from the ground."),
          params::number("max_height_m", &Params::max_height_m, {0.0, 100.0},
                         "The sensor is at most this far from the ground."),
          params::integer("planes", &Params::planes, {1, 100},
                          "So many planes are taken from the cloud, the largest first."),
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
    if (candidates.empty()) throw StageError("no plane may be the ground below the sensor");
    return ground_from_planes(cloud.points, {candidates.front().plane}, params_, rng);
  }

 private:
  Params params_;
};

}  // namespace

StageEntry plausible_plane() {
  return stage_entry<PlausiblePlane>(
      "plausible_plane",
      "Takes the largest planes and of them the one that may be the ground: below the sensor, "
      "however it is mounted, with a large area and few returns behind it.",
      "croon", table());
}

}  // namespace croon::stages::ground_extractor

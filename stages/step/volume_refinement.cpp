#include <set>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/params/values.hpp"
#include "framework/pipeline/step_options.hpp"
#include "framework/spatial/leaf_grid.hpp"
#include "framework/stage/pose_search.hpp"
#include "framework/stage/stage_entry.hpp"
#include "framework/stage/step.hpp"
#include "framework/stage/volume_scorer.hpp"

namespace croon::stages::step {
namespace {

struct Params {
  params::Slot<VolumeScorer> scorer;
  params::Slot<PoseSearch> search;
  PointSelection points = PointSelection::non_ground;
  double overlap_cube_m = 0.0;
};

const params::Table<Params>& table() {
  static const params::Table<Params> table = {
      params::slot("scorer", &Params::scorer, R"({"type": "pointer_octree"})",
                   "Computes the volume that the two clouds occupy together."),
      params::slot("search", &Params::search, R"({"type": "coordinate_scan"})",
                   "Finds the pose of minimum volume."),
      params::choice("points", &Params::points, kPointsWords, "Points that occupy volume."),
      params::number(
          "overlap_cube_m", &Params::overlap_cube_m, {0.0, 1000.0},
          "If not 0, only those of the sensor's points are used that, at the initial pose of this "
          "step, lie in cubes of this edge that contain points of the reference."),
  };
  return table;
}

/// The source's points in cubes that contain points of the target. They are chosen once for all
/// poses of a search, since otherwise clouds that move apart would occupy less. The target keeps
/// all its points: those outside the overlap add the same volume at every pose. Throws StageError
/// if no point is left.
std::shared_ptr<const Cloud> overlapping(const SelectedClouds& clouds,
                                         const RigidTransform& T_target_source, double cube_m) {
  const LeafGrid cubes(cube_m);
  const auto of_target =
      clouds.target->once<std::set<LeafKey>>("overlap_cubes", params::value_json(cube_m), [&] {
        const auto set = std::make_shared<std::set<LeafKey>>();
        for (const Eigen::Vector3f& p : clouds.target->points()) {
          set->insert(leaf_key(cubes.leaf_of(p.cast<double>())));
        }
        return set;
      });
  Points kept;
  for (const Eigen::Vector3f& p : clouds.source->points()) {
    if (of_target->count(leaf_key(cubes.leaf_of(T_target_source * p.cast<double>()))) > 0)
      kept.push_back(p);
  }
  if (kept.empty()) throw StageError("the two clouds have no common cube of overlap_cube_m");
  return clouds.source->derived_in_trial(std::move(kept), "overlap");
}

class VolumeRefinement final : public Step {
 public:
  explicit VolumeRefinement(Params params) : params_(std::move(params)) {}

  Estimate advance(Estimate estimate, Rng&) const override {
    SelectedClouds clouds = selected_clouds(estimate, params_.points);
    if (params_.overlap_cube_m > 0.0) {
      clouds.source = overlapping(clouds, estimate.T_target_source, params_.overlap_cube_m);
    }
    const VolumeFunction volume = params_.scorer->bind(clouds.target, clouds.source);
    const double before_m3 = volume(estimate.T_target_source).m3;
    const PoseMinimum minimum =
        params_.search->minimise(volume_cost(volume), estimate.T_target_source);
    estimate.set_pose(minimum.pose);
    estimate.diagnostics = {{"volume_before_m3", before_m3},
                            {"volume_m3", minimum.cost},
                            {"evaluations", static_cast<double>(minimum.evaluations)}};
    return estimate;
  }

 private:
  Params params_;
};

}  // namespace

StageEntry volume_refinement() {
  return stage_entry<VolumeRefinement>(
      "volume_refinement",
      "Moves the sensor to the pose at which the two clouds together occupy the minimum volume.",
      "CROON (arXiv 2203.03182), refinement", table());
}

}  // namespace croon::stages::step
